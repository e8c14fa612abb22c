#include <tools/benchmark/coast_lines.hpp>
#include <tools/benchmark/outlines.hpp>
#include <tools/benchmark/paper_scenes.hpp>
#include <tools/peers/worlds/contest.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::peers {
namespace {

using benchmark::Random;

constexpr double whole_turn = 2.0 * std::numbers::pi;

Pose anywhere(Random& random, const Vector2& low, const Vector2& high) {
    return {{random.between(low.x, high.x), random.between(low.y, high.y)},
            random.between(0.0, whole_turn)};
}

/// 48 items of 21 vertices side by side, and another one at many poses among and beside them.
WorldProblem layout() {
    WorldProblem problem;
    problem.name = "48 items, 1,008 vertices: an item at 1,000,000 poses, hit or not";
    Random random(41);
    for (int i = 0; i < 48; ++i) {
        problem.shapes.push_back(
            {{benchmark::star(random, 21)},
             {{2.1 * (i % 8), 2.1 * (i / 8)}, random.between(0.0, whole_turn)}});
    }
    problem.item = {benchmark::star(random, 21)};
    for (int i = 0; i < 1'000'000; ++i) {
        problem.poses.push_back(anywhere(random, {-4.0, -4.0}, {32.0, 20.0}));
    }
    return problem;
}

/// Paths of a footprint over coast lines: both islands twice, 10,612 edges in all.
WorldProblem paths() {
    WorldProblem problem;
    problem.name = "112,000 footprints of 12 vertices, 10,612 edges: least distances";
    problem.asks_distances = true;
    problem.shapes = {{benchmark::iceland(), {{0.0, 0.0}, 0.0}},
                      {benchmark::ireland(), {{600.0, 0.0}, 0.0}},
                      {benchmark::iceland(), {{0.0, 600.0}, 2.0}},
                      {benchmark::ireland(), {{600.0, 600.0}, 4.0}}};
    Ring footprint;
    for (int i = 0; i < 12; ++i) {
        const double angle = whole_turn * i / 12.0;
        footprint.push_back({4.0 * std::cos(angle), 2.0 * std::sin(angle)});
    }
    problem.item = {footprint};
    Random random(43);
    for (int path = 0; path < 2000; ++path) {
        Pose pose = anywhere(random, {-400.0, -400.0}, {1000.0, 1000.0});
        const double bend = random.between(-0.1, 0.1);
        for (int i = 0; i < 56; ++i) {
            problem.poses.push_back(pose);
            pose.translation.x += 2.0 * std::cos(pose.angle);
            pose.translation.y += 2.0 * std::sin(pose.angle);
            pose.angle += bend;
        }
    }
    return problem;
}

WorldProblem many_polygons() {
    WorldProblem problem;
    problem.name = "100,000 polygons of 50 vertices: the nearest of 1,000,000 points";
    Random random(47);
    for (int i = 0; i < 100'000; ++i) {
        problem.shapes.push_back(
            {{benchmark::star(random, 50)}, anywhere(random, {0.0, 0.0}, {1000.0, 1000.0})});
    }
    for (int i = 0; i < 1'000'000; ++i) {
        problem.points.push_back(anywhere(random, {0.0, 0.0}, {1000.0, 1000.0}).translation);
    }
    return problem;
}

WorldProblem rays() {
    WorldProblem problem;
    problem.name = "map x100, 71,900 edges: the first hit of 1,000,000 rays";
    const tools::Scene scene = benchmark::map_scene(100);
    Vector2 low{1e300, 1e300};
    Vector2 high{-1e300, -1e300};
    for (const tools::SceneInstance& instance : scene.instances) {
        problem.shapes.push_back({scene.shapes[instance.shape].rings, instance.pose});
        for (const Ring& ring : problem.shapes.back().rings) {
            for (const Vector2& vertex : ring) {
                const Vector2 at = at_pose(vertex, instance.pose);
                low = {std::min(low.x, at.x), std::min(low.y, at.y)};
                high = {std::max(high.x, at.x), std::max(high.y, at.y)};
            }
        }
    }
    Random random(53);
    for (int i = 0; i < 1'000'000; ++i) {
        problem.segments.push_back(
            {anywhere(random, low, high).translation, anywhere(random, low, high).translation});
    }
    return problem;
}

}  // namespace

Vector2 at_pose(const Vector2& point, const Pose& pose) {
    const double c = std::cos(pose.angle);
    const double s = std::sin(pose.angle);
    return {c * point.x - s * point.y + pose.translation.x,
            s * point.x + c * point.y + pose.translation.y};
}

std::vector<WorldProblem> world_problems() {
    return {layout(), paths(), many_polygons(), rays()};
}

}  // namespace nearfield::peers
