#include <tools/benchmark/measuring.hpp>
#include <tools/benchmark/workloads.hpp>
#include <tools/common/library.hpp>
#include <tools/simulation/clearance_scenes.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/scenes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace nearfield::simulation {
namespace {

template <class Scene>
std::unique_ptr<ClearanceScene> made(Context& context) {
    auto scene = std::make_unique<Scene>(context);
    scene->ask();
    return scene;
}

constexpr NamedClearanceScene scenes_of_clearances[] = {{"nest", made<Nest>},
                                                        {"robots", made<Robots>}};

std::size_t edges_of(const std::vector<Ring>& rings) {
    std::size_t count = 0;
    for (const Ring& ring : rings) {
        count += ring.size();
    }
    return count;
}

}  // namespace

std::span<const NamedClearanceScene> clearance_scenes() {
    return scenes_of_clearances;
}

ClearanceScene::ClearanceScene(Context& context, const Setting& setting)
    : context_(context),
      world_(tools::take(nearfield::World::create(context))),
      name_(setting.name),
      view_(setting.view),
      poses_a_path_(setting.poses_a_path),
      min_clearance_(setting.min_clearance),
      max_clearance_(setting.max_clearance) {}

ClearanceScene::~ClearanceScene() {
    for (const ShapeHandle& shape : shapes_) {
        [[maybe_unused]] const Status status = context_.remove_shape(shape);
    }
}

ShapeHandle ClearanceScene::add_shape(const std::vector<Ring>& rings) {
    return shapes_.emplace_back(tools::take(context_.add_shape(rings)));
}

void ClearanceScene::add_obstacle(std::vector<Ring> rings, const Pose& pose) {
    const ShapeHandle shape = add_shape(rings);
    const InstanceHandle instance =
        tools::take(world_.add({.shape = shape, .pose = pose, .user = obstacles_.size()}));
    obstacles_.push_back({std::move(rings), pose, shape, instance});
}

std::optional<std::size_t> ClearanceScene::obstacle_at(Vector2 point) {
    InstanceLists found;
    tools::require(world_.find_overlaps(std::span(&point, 1), found));
    if (found.instances.empty()) {
        return std::nullopt;
    }
    return tools::take(world_.instance(found.instances.back())).user;
}

void ClearanceScene::advance() {
    ++frames_;
    frame_.time = frame_time * static_cast<double>(frames_);
    move();
    ask();
}

ClearanceQuery ClearanceScene::query() const {
    ClearanceQuery query{.shape = shape_};
    query.min_clearance = min_clearance_;
    query.max_clearance = max_clearance_;
    return query;
}

WorldFilter ClearanceScene::filter() const {
    return {.ignored =
                moving_obstacle_ ? obstacles_[*moving_obstacle_].instance : InstanceHandle()};
}

void ClearanceScene::ask() {
    poses_.clear();
    list_poses(poses_);
    clearances_.resize(poses_.size());
    frame_.milliseconds = benchmark::milliseconds_of([this] {
        tools::require(world_.find_clearances(query(), poses_, clearances_, {.filter = filter()}));
    });
    least_.clear();
    frame_.free_paths = 0;
    for (std::size_t first = 0; first < poses_.size(); first += poses_a_path_) {
        std::size_t least = first;
        for (std::size_t pose = first; pose < first + poses_a_path_; ++pose) {
            least = clearances_[pose].distance < clearances_[least].distance ? pose : least;
        }
        least_.push_back(least);
        frame_.free_paths += clearances_[least].distance > 0.0 ? 1U : 0U;
    }
    frame_.pose = pose_;
    frame_.poses = poses_.size();
    frame_.paths = least_.size();
    frame_.best_path = best_path();
    frame_.clearance = clearance(frame_.best_path);
    frame_.neighbor.reset();
    if (frame_.clearance.instance != InstanceHandle{}) {
        frame_.neighbor = tools::take(world_.instance(frame_.clearance.instance)).user;
    }
}

std::span<const Pose> ClearanceScene::path(std::size_t path) const {
    return std::span(poses_).subspan(path * poses_a_path_, poses_a_path_);
}

std::size_t ClearanceScene::line_count() const {
    std::size_t count = moving_obstacle_ ? 0 : edges_of(mover());
    for (const Obstacle& obstacle : obstacles_) {
        count += edges_of(obstacle.rings);
    }
    return count;
}

namespace {

Ring circle(double radius, std::size_t vertices, Vector2 center = {}) {
    Ring ring;
    for (std::size_t i = 0; i < vertices; ++i) {
        const double turn = static_cast<double>(i) / static_cast<double>(vertices);
        ring.push_back(center + polar(radius, 2.0 * std::numbers::pi * turn));
    }
    return ring;
}

Ring scaled(Ring ring, double scale) {
    for (Vector2& vertex : ring) {
        vertex = scale * vertex;
    }
    return ring;
}

NestItem wheel() {
    return {gear_outline(9), circle(0.55, 20)};
}

NestItem washer() {
    return {circle(1.2, 32), circle(0.78, 24)};
}

NestItem channel() {
    return {{{-1.1, -0.9},
             {1.1, -0.9},
             {1.1, 0.9},
             {0.7, 0.9},
             {0.7, -0.45},
             {-0.7, -0.45},
             {-0.7, 0.9},
             {-1.1, 0.9}}};
}

NestItem bracket() {
    return {{{-0.9, -1.1},
             {1.2, -1.1},
             {1.2, -0.5},
             {0.1, -0.3},
             {-0.2, 0.1},
             {-0.3, 1.2},
             {-0.9, 1.2}},
            circle(0.18, 12, {-0.6, 0.8}),
            circle(0.18, 12, {0.8, -0.8})};
}

NestItem hook() {
    return {scaled(benchmark::link(30), 0.6)};
}

NestItem gusset() {
    return {{{-0.9, -0.7}, {1.3, -0.7}, {1.3, -0.5}, {-0.7, 1.3}, {-0.9, 1.3}},
            {{-0.5, -0.35}, {0.35, -0.35}, {-0.5, 0.45}}};
}

NestItem scrap(std::uint64_t seed) {
    return {scaled(benchmark::coast(seed, 40), 0.75)};
}

NestItem star(std::uint64_t seed) {
    benchmark::Random random(seed);
    return {scaled(benchmark::star(random, 14), 0.62)};
}

/// Items of eight kinds, most of them not convex and some with holes, the larger ones first.
std::vector<NestItem> nest_items() {
    std::vector<NestItem> items;
    for (const auto make : {wheel, washer, hook, bracket, channel, gusset}) {
        for (int i = 0; i < 4; ++i) {
            items.push_back(make());
        }
    }
    for (const auto make : {scrap, star}) {
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
            items.push_back(make(seed));
        }
    }
    return items;
}

constexpr double strip_length = 21.0;
constexpr double strip_width = 8.6;
constexpr double edge_width = 0.3;
/// The item that follows a path until the user takes one.
constexpr std::size_t wanderer = 16;

Ring box(Vector2 min, Vector2 max) {
    return {min, {max.x, min.y}, max, {min.x, max.y}};
}

/// The strip's edge.
std::vector<Ring> edge() {
    return {box({-edge_width, -edge_width}, {strip_length + edge_width, strip_width + edge_width}),
            box({}, {strip_length, strip_width})};
}

/// Back and forth between the free end of the strip and the items.
Pose on_its_way(double time) {
    return {
        {11.0 + 7.8 * sine_cosine(0.35 * time).cosine, 4.3 + 2.9 * sine_cosine(0.91 * time).sine},
        0.4 * time};
}

}  // namespace

Nest::Nest(Context& context)
    : ClearanceScene(context, {.name = "nest",
                               .view = {{-0.7, -2.2}, {strip_length + 0.7, strip_width + 0.7}}}) {
    add_obstacle(edge(), {});
    for (NestItem& item : nest_items()) {
        nest(std::move(item));
    }
    take(wanderer);
    place(on_its_way(0.0));
}

void Nest::nest(std::vector<Ring> item) {
    constexpr double gap = 0.1;
    constexpr double step = 0.15;
    ClearanceQuery query{.shape = add_shape(item)};
    query.min_clearance = 0.0;
    query.max_clearance = gap;
    std::vector<Pose> poses;
    std::vector<Clearance> clearances;
    const auto columns = static_cast<int>(strip_length / step);
    const auto rows = static_cast<int>(strip_width / step);
    for (int column = 0; column <= columns; ++column) {
        poses.clear();
        for (int row = 0; row <= rows; ++row) {
            for (int quarter = 0; quarter < 4; ++quarter) {
                poses.push_back({{step * column, step * row}, 0.5 * std::numbers::pi * quarter});
            }
        }
        clearances.resize(poses.size());
        tools::require(world().find_clearances(query, poses, clearances));
        for (std::size_t i = 0; i < poses.size(); ++i) {
            if (clearances[i].distance >= gap) {
                add_obstacle(std::move(item), poses[i]);
                return;
            }
        }
    }
    throw std::logic_error("an item does not fit into the strip");
}

void Nest::take(std::size_t item) {
    moving_obstacle_ = item;
    shape_ = obstacles_[item].shape;
    pose_ = obstacles_[item].pose;
}

void Nest::place(const Pose& pose) {
    Obstacle& item = obstacles_[*moving_obstacle_];
    tools::require(world().move(item.instance, pose));
    pose_ = item.pose = pose;
}

void Nest::move() {
    if (!taken_by_user_) {
        place(on_its_way(frame().time));
    }
}

void Nest::grab(Vector2 point) {
    release();
    const std::optional<std::size_t> item = obstacle_at(point);
    if (item.value_or(0) == 0) {
        return;  // nothing, or the strip's edge
    }
    taken_by_user_ = true;
    take(*item);
    held_ = point - pose_.translation;
}

void Nest::drag(Vector2 point) {
    if (held_) {
        place({point - *held_, pose_.angle});
    }
}

namespace {

constexpr Vector2 map_size{24.0, 13.0};
/// Paths differ in the curvature at their start and at their end.
constexpr std::size_t starts = 50;
constexpr std::size_t ends = 40;
constexpr std::size_t poses_a_path = 40;
constexpr double path_length = 7.0;
constexpr double max_curvature = 1.3;
constexpr double speed = 1.5;          // a second
constexpr double turning_speed = 1.0;  // radians a second, where all paths are blocked
constexpr double comfort = 0.4;        // a smaller clearance has its cost
constexpr double price_of_discomfort = 8.0;
constexpr double goal_radius = 0.5;

constexpr std::array<Vector2, 6> goals{
    {{22.5, 11.5}, {1.5, 11.0}, {12.0, 6.5}, {22.5, 1.2}, {6.5, 6.0}, {1.5, 1.5}}};

/// Where islands lie: the number of the country, and its pose.
struct Island {
    std::size_t country;
    Pose pose;
};
constexpr std::array<Island, 12> islands{{{0, {{4.0, 3.6}, 0.0}},
                                          {1, {{9.0, 2.6}, 0.4}},
                                          {2, {{14.4, 2.6}, 0.2}},
                                          {4, {{19.6, 3.4}, 0.6}},
                                          {3, {{3.2, 8.4}, 1.2}},
                                          {5, {{9.6, 6.6}, 0.5}},
                                          {1, {{15.4, 6.8}, 2.0}},
                                          {0, {{20.4, 7.6}, 2.6}},
                                          {4, {{6.6, 10.8}, 1.4}},
                                          {2, {{12.0, 10.4}, 3.0}},
                                          {3, {{17.4, 10.6}, 0.9}},
                                          {5, {{22.0, 4.0}, 1.5}}}};

/// A vehicle of 12 vertices with a blunt bow.
Ring vehicle() {
    return {{0.42, 0.0}, {0.36, 0.12},   {0.22, 0.2},  {-0.1, 0.22},  {-0.3, 0.2},  {-0.38, 0.14},
            {-0.4, 0.0}, {-0.38, -0.14}, {-0.3, -0.2}, {-0.1, -0.22}, {0.22, -0.2}, {0.36, -0.12}};
}

double fraction(std::size_t part, std::size_t count) {
    return static_cast<double>(part) / static_cast<double>(count - 1);
}

/// The pose at the end of an arc of this length and curvature.
Pose along_arc(const Pose& from, double curvature, double length) {
    const double half_turn = 0.5 * curvature * length;
    const double chord =
        half_turn == 0.0 ? length : length * sine_cosine(half_turn).sine / half_turn;
    return {from.translation + polar(chord, from.angle + half_turn), from.angle + 2.0 * half_turn};
}

/// A path's curvature at a fraction of its length: from -max_curvature to max_curvature.
double curvature(std::size_t path, double part) {
    const double start = fraction(path / ends, starts);
    const double end = fraction(path % ends, ends);
    return max_curvature * (2.0 * std::lerp(start, end, part) - 1.0);
}

}  // namespace

Robots::Robots(Context& context)
    : ClearanceScene(context, {.name = "robots",
                               .view = {{0.0, -1.7}, map_size},
                               .poses_a_path = poses_a_path,
                               .min_clearance = 0.0,
                               .max_clearance = 0.6}),
      footprint_{vehicle()} {
    const std::vector<Ring> outlines = countries(3.6);
    for (const Island& island : islands) {
        add_obstacle({outlines[island.country]}, island.pose);
    }
    shape_ = add_shape(footprint_);
    pose_ = {{1.2, 1.2}, 0.6};
    goal_ = goals[next_goal_];
}

void Robots::list_poses(std::vector<Pose>& poses) const {
    for (std::size_t path = 0; path < starts * ends; ++path) {
        Pose pose = pose_;
        for (std::size_t i = 0; i < poses_a_path; ++i) {
            poses.push_back(pose);
            pose = along_arc(pose, curvature(path, fraction(i, poses_a_path)),
                             path_length / static_cast<double>(poses_a_path - 1));
        }
    }
}

double Robots::cost(std::size_t path) const {
    const double clear = clearance(path).distance;
    if (clear <= 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const Pose& pose : this->path(path)) {
        nearest = std::min(nearest, length(*goal_ - pose.translation));
    }
    return nearest + price_of_discomfort * std::max(0.0, comfort - clear);
}

std::size_t Robots::best_path() const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t path = 0; path < starts * ends; ++path) {
        const double cost = this->cost(path);
        if (cost < least) {
            least = cost;
            best = path;
        }
    }
    return best;
}

void Robots::move() {
    if (length(*goal_ - pose_.translation) < goal_radius && held_ != Held::goal) {
        next_goal_ = (next_goal_ + 1) % goals.size();
        goal_ = goals[next_goal_];
    }
    if (held_ == Held::robot) {
        return;
    }
    if (frame().free_paths == 0) {
        pose_.angle += turning_speed * frame_time;
    } else {
        pose_ = along_arc(pose_, curvature(frame().best_path, 0.0), speed * frame_time);
    }
}

void Robots::grab(Vector2 point) {
    release();
    constexpr double reach = 0.6;
    if (length(point - pose_.translation) <= reach) {
        held_ = Held::robot;
        offset_ = point - pose_.translation;
    } else if (length(point - *goal_) <= reach) {
        held_ = Held::goal;
        offset_ = point - *goal_;
    }
}

void Robots::drag(Vector2 point) {
    if (held_ == Held::robot) {
        pose_.translation = point - offset_;
    } else if (held_ == Held::goal) {
        goal_ = point - offset_;
    }
}

}  // namespace nearfield::simulation
