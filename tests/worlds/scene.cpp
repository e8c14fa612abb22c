#include "scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

constexpr double turn = 6.283185307179586;

Pose pose_in(Random& random, double half, const Vector2& centre = {}) {
    return {{centre.x + random.between(-half, half), centre.y + random.between(-half, half)},
            random.between(-turn, turn)};
}

void add_ordinary(Random& random, std::vector<Placement>& scene, const Vector2& centre) {
    const int count = random.whole(3, 40);
    for (int i = 0; i < count; ++i) {
        NamedRings shape = any_shape(random);
        scene.push_back({shape.name, scaled_and_moved(shape.rings, random.scale(0.1, 2.0), {}),
                         pose_in(random, 5.0, centre)});
    }
}

void add_families(Random& random, std::vector<Placement>& scene, std::uint64_t seed) {
    int i = 0;
    for (NamedRings& shape : every_family(seed)) {
        Pose pose = pose_in(random, 0.3);
        pose.translation.x += 1.9 * (i % 5);
        pose.translation.y += 1.9 * static_cast<double>(i / 5);
        scene.push_back({shape.name, std::move(shape.rings), pose});
        ++i;
    }
}

void add_far_origin(Random& random, std::vector<Placement>& scene) {
    for (int i = 0; i < 15; ++i) {
        const NamedRings shape = any_shape(random);
        const Vector2 by{random.between(-3e6, 3e6), random.between(-3e6, 3e6)};
        Pose back = pose_in(random, 4.0);
        const Vector2 there = moved_by({{}, back.angle}, by);
        back.translation = {back.translation.x - there.x, back.translation.y - there.y};
        scene.push_back(
            {shape.name + " far from its origin", scaled_and_moved(shape.rings, 1.0, by), back});
    }
}

void add_sizes(Random& random, std::vector<Placement>& scene) {
    for (int i = 0; i < 25; ++i) {
        const NamedRings shape = any_shape(random);
        const double size = random.scale(1e-6, 1e3);
        scene.push_back({shape.name, scaled_and_moved(shape.rings, size, {}),
                         pose_in(random, 20.0 + 2.0 * size)});
    }
}

void add_grid(Random& random, std::vector<Placement>& scene) {
    const int side = random.whole(2, 6);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const int times = random.whole(0, 2);
            for (int i = 0; i < times; ++i) {
                scene.push_back({"unit square",
                                 rectangle({0.0, 0.0}, {1.0, 1.0}),
                                 {{static_cast<double>(x), static_cast<double>(y)}, 0.0}});
            }
        }
    }
    scene.push_back(
        {"diamond", {{{-1.0, 0.0}, {0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}}}, {{2.0, 2.0}}});
    scene.push_back({"one square twice",
                     {rectangle({0.0, 0.0}, {1.0, 1.0})[0], rectangle({1.0, 1.0}, {2.0, 2.0})[0]},
                     {{1.0, 0.0}}});
}

void add_holes(Random& random, std::vector<Placement>& scene) {
    for (int i = 0; i < 4; ++i) {
        const Vector2 at{12.0 * i, 0.0};
        const Rings rings = i % 2 == 0 ? with_holes(random, random.whole(5, 30))
                                       : several_parts(random, random.whole(3, 9));
        scene.push_back({"with many rings", scaled_and_moved(rings, 5.0, {}), {at, 0.3 * i}});
        for (int inside = 0; inside < 8; ++inside) {
            const double size = random.scale(0.01, 0.5);
            scene.push_back({"inside", scaled_and_moved(star(random, 9, 0.5), size, {}),
                             pose_in(random, 4.0, at)});
        }
    }
}

void add_extremes(Random& random, std::vector<Placement>& scene) {
    for (int i = 0; i < 8; ++i) {
        const double small = random.scale(1e-18, 1e-9);
        scene.push_back({"small", scaled_and_moved(any_shape(random).rings, small, {}),
                         pose_in(random, small)});
        const double large = random.scale(1e8, 1e11);
        scene.push_back(
            {"large", scaled_and_moved(any_shape(random).rings, large, {}), pose_in(random, 4e11)});
    }
}

}  // namespace

const char* to_string(SceneKind kind) {
    constexpr const char* names[] = {"ordinary",     "every family", "far away", "far origin",
                                     "tiny and big", "grid",         "holes",    "extreme"};
    return names[static_cast<int>(kind)];
}

Vector2 moved_by(const Pose& motion, const Vector2& point) {
    const double c = std::cos(motion.angle);
    const double s = std::sin(motion.angle);
    return {c * point.x - s * point.y + motion.translation.x,
            s * point.x + c * point.y + motion.translation.y};
}

Pose moved_by(const Pose& motion, const Pose& pose) {
    return {moved_by(motion, pose.translation), motion.angle + pose.angle};
}

std::vector<Placement> make_scene(SceneKind kind, std::uint64_t seed) {
    Random random(seed);
    std::vector<Placement> scene;
    switch (kind) {
        case SceneKind::ordinary:
            add_ordinary(random, scene, {});
            break;
        case SceneKind::every_family:
            add_families(random, scene, seed);
            break;
        case SceneKind::far_away:
            add_ordinary(random, scene, {1e6, -3e6});
            break;
        case SceneKind::far_origin:
            add_far_origin(random, scene);
            break;
        case SceneKind::tiny_and_big:
            add_sizes(random, scene);
            break;
        case SceneKind::grid:
            add_grid(random, scene);
            break;
        case SceneKind::holes:
            add_holes(random, scene);
            break;
        case SceneKind::extreme:
            add_extremes(random, scene);
            break;
    }
    for (Placement& placement : scene) {
        if (random.whole(0, 4) == 0) {
            placement.category = 1U << static_cast<unsigned>(random.whole(0, 3));
            placement.mask = static_cast<std::uint32_t>(random.whole(1, 15));
        }
    }
    return scene;
}

Rectangle box_of(const std::vector<Placement>& placements) {
    Rectangle box{{infinity, infinity}, {-infinity, -infinity}};
    for (const Placement& placement : placements) {
        const PlacedRings placed(placement.rings, placement.pose);
        for (const WidePoint& v : placed.vertices()) {
            const Vector2 at{static_cast<double>(v.x), static_cast<double>(v.y)};
            box.min = {std::min(box.min.x, at.x), std::min(box.min.y, at.y)};
            box.max = {std::max(box.max.x, at.x), std::max(box.max.y, at.y)};
        }
    }
    return box;
}

double size_of(SceneKind kind, const Rectangle& box) {
    return std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x),
                     std::abs(box.max.y), kind == SceneKind::far_origin ? 1e8 : 1e7});
}

std::vector<Placement> unit_squares(std::initializer_list<Vector2> corners) {
    std::vector<Placement> placements;
    for (const Vector2& corner : corners) {
        placements.push_back({"unit square", rectangle({0.0, 0.0}, {1.0, 1.0}), {corner, 0.0}});
    }
    return placements;
}

std::vector<SceneKind> all_scene_kinds() {
    std::vector<SceneKind> kinds;
    for (int kind = 0; kind < scene_kinds; ++kind) {
        kinds.push_back(static_cast<SceneKind>(kind));
    }
    return kinds;
}

Scene::Scene(std::vector<Placement> placements, const Settings& settings)
    : placements_(std::move(placements)) {
    Expected<Context> context = Context::create_cpu(settings);
    EXPECT_TRUE(context.has_value()) << context.error().text();
    context_.emplace(std::move(*context));
    Expected<World> world = World::create(*context_);
    EXPECT_TRUE(world.has_value()) << world.error().text();
    world_.emplace(std::move(*world));
    for (std::size_t i = 0; i < placements_.size(); ++i) {
        const Placement& placement = placements_[i];
        shapes_.push_back(add_shape(placement.rings));
        const Expected<InstanceHandle> handle = world_->add(
            {shapes_.back(), placement.pose, 100 + i, placement.category, placement.mask});
        EXPECT_TRUE(handle.has_value()) << handle.error().text();
        handles_.push_back(*handle);
        poses_.push_back(placement.pose);
        truths_.emplace_back(placement.rings, placement.pose);
    }
}

ShapeHandle Scene::add_shape(const Rings& rings) {
    const Expected<ShapeHandle> shape = context_->add_shape(rings);
    EXPECT_TRUE(shape.has_value()) << shape.error().text() << to_text(rings);
    return *shape;
}

std::optional<std::size_t> Scene::position(InstanceHandle handle) const {
    const auto found = std::find(handles_.begin(), handles_.end(), handle);
    if (found == handles_.end()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - handles_.begin());
}

bool Scene::passes(std::size_t i, const WorldFilter& filter) const {
    return (placements_[i].category & filter.mask) != 0 &&
           (placements_[i].mask & filter.category) != 0 && !(filter.ignored == handles_[i]);
}

Asked any_asked(Random& random, Scene& scene) {
    if (random.whole(0, 2) == 0) {
        const auto i =
            static_cast<std::size_t>(random.whole(0, static_cast<int>(scene.size()) - 1));
        return {scene.shape(i), scene.placements()[i].rings};
    }
    // Shapes of many edges are searched by trees, others by brute force.
    const Rings any = random.whole(0, 2) == 0 ? star(random, random.whole(257, 600), 0.5)
                                              : any_shape(random).rings;
    const Rings rings = scaled_and_moved(any, random.scale(0.05, 3.0), {});
    return {scene.add_shape(rings), rings};
}

WorldFilter any_filter(Random& random, const Scene& scene) {
    WorldFilter filter;
    switch (random.whole(0, 5)) {
        case 0:
            filter.mask = static_cast<std::uint32_t>(random.whole(1, 15));
            break;
        case 1:
            filter.category = static_cast<std::uint32_t>(random.whole(1, 15));
            break;
        case 2:
            filter.ignored = scene.handle(
                static_cast<std::size_t>(random.whole(0, static_cast<int>(scene.size()) - 1)));
            break;
        default:
            break;
    }
    return filter;
}

namespace {

const WideEdge& any_edge(Random& random, const Scene& scene) {
    const PlacedRings& truth =
        scene.truth(static_cast<std::size_t>(random.whole(0, static_cast<int>(scene.size()) - 1)));
    return truth.edges()[static_cast<std::size_t>(
        random.whole(0, static_cast<int>(truth.edges().size()) - 1))];
}

Vector2 along(const WideEdge& edge, double t) {
    return {static_cast<double>(edge.from.x + t * (edge.to.x - edge.from.x)),
            static_cast<double>(edge.from.y + t * (edge.to.y - edge.from.y))};
}

}  // namespace

Vector2 any_point(Random& random, const Scene& scene, const Rectangle& box) {
    const double width = box.max.x - box.min.x;
    const double height = box.max.y - box.min.y;
    switch (random.whole(0, 7)) {
        case 0:
            return along(any_edge(random, scene), 0.0);
        case 1:
            return along(any_edge(random, scene), random.between(0.0, 1.0));
        case 2: {
            const Vector2 on = along(any_edge(random, scene), random.between(0.0, 1.0));
            const double off = random.scale(1e-9, 1.0);
            return {on.x + random.between(-off, off), on.y + random.between(-off, off)};
        }
        case 3:
            return {box.min.x + random.between(-1e6, 1e6), box.min.y + random.between(-1e6, 1e6)};
        default:
            return {box.min.x + random.between(-0.2, 1.2) * width,
                    box.min.y + random.between(-0.2, 1.2) * height};
    }
}

namespace {

Segment any_way(Random& random, const Scene& scene, const Rectangle& box) {
    const Vector2 from = any_point(random, scene, box);
    const Vector2 to = any_point(random, scene, box);
    const WideEdge& edge = any_edge(random, scene);
    switch (random.whole(0, 7)) {
        case 0:
            return {from, from};
        case 1:  // through a vertex, and beyond
            return {from, along({wide(from), edge.from}, random.between(0.5, 2.5))};
        case 2:  // along an edge, and beyond
            return {along(edge, random.between(-2.0, 0.5)), along(edge, random.between(0.5, 3.0))};
        case 3:  // backwards, from vertex to vertex
            return {along(edge, 1.0), along(edge, 0.0)};
        case 4: {  // from very far away, through
            const double angle = random.between(0.0, turn);
            const Vector2 way{1e6 * std::cos(angle), 1e6 * std::sin(angle)};
            const Vector2 on = along(edge, random.between(0.0, 1.0));
            return {{on.x - way.x, on.y - way.y}, {on.x + way.x, on.y + way.y}};
        }
        case 5:  // horizontal or vertical
            return random.whole(0, 1) == 0 ? Segment{from, {to.x, from.y}}
                                           : Segment{from, {from.x, to.y}};
        default:
            return {from, to};
    }
}

/// As near as coordinates may be.
Vector2 within_limits(const Vector2& v) {
    return {std::clamp(v.x, -largest_coordinate, largest_coordinate),
            std::clamp(v.y, -largest_coordinate, largest_coordinate)};
}

}  // namespace

Segment any_segment(Random& random, const Scene& scene, const Rectangle& box) {
    const Segment segment = any_way(random, scene, box);
    return {within_limits(segment.from), within_limits(segment.to)};
}

}  // namespace nearfield::test
