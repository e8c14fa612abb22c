#include <tools/benchmark/workloads.hpp>
#include <tools/common/library_error.hpp>
#include <tools/simulation/nest.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/scenes.hpp>

#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace nearfield::simulation {
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

}  // namespace nearfield::simulation
