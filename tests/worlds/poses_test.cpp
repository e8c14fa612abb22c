#include "scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

/// Poses at which a shape is likely to be near something: a walk, jumps, and poses of instances.
std::vector<Pose> poses_around(Random& random, const Scene& scene, const Rectangle& box,
                               int count) {
    std::vector<Pose> poses;
    for (int i = 0; i < count; ++i) {
        const int way = random.whole(0, 9);
        if (way == 0) {
            poses.push_back(scene
                                .placements()[static_cast<std::size_t>(
                                    random.whole(0, static_cast<int>(scene.size()) - 1))]
                                .pose);
        } else if (way < 6 || poses.empty()) {
            poses.push_back({any_point(random, scene, box), random.between(-7.0, 7.0)});
        } else {
            Pose next = poses.back();
            next.translation.x += random.between(-0.1, 0.1);
            next.translation.y += random.between(-0.1, 0.1);
            next.angle += random.between(-0.1, 0.1);
            poses.push_back(next);
        }
    }
    return poses;
}

/// A shape to ask with: any, or one that is in the world already.
struct Asked {
    ShapeHandle shape;
    Rings rings;
};

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

/// The answers of a batch about one pose and every instance that passes.
struct BatchAnswers {
    std::vector<std::size_t> instances;
    std::vector<bool> intersects;
    std::vector<double> distance;
};

BatchAnswers ask_batch(Scene& scene, const Instance& shape, double magnitude,
                       const WorldFilter& filter) {
    BatchAnswers answers;
    Batch batch;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        if (scene.passes(i, filter)) {
            answers.instances.push_back(i);
            batch.add(IntersectionTestQuery{shape, scene.instance(i)});
            const double tolerance = 1e-6 * (magnitude + scene.truth(i).magnitude());
            batch.add(SeparationQuery{shape, scene.instance(i), tolerance, Technique::cpu});
        }
    }
    Results results;
    const Status status = scene.context().run(batch, results);
    EXPECT_TRUE(status.ok()) << status.text();
    for (std::size_t i = 0; i < answers.instances.size(); ++i) {
        const auto& test = std::get<IntersectionTestResult>(results.results[2 * i]);
        const auto& separation = std::get<SeparationResult>(results.results[2 * i + 1]);
        EXPECT_TRUE(test.status.ok() && separation.status.ok()) << separation.status.text();
        answers.intersects.push_back(test.intersects);
        answers.distance.push_back(separation.distance);
    }
    return answers;
}

std::vector<std::size_t> met(const BatchAnswers& answers) {
    std::vector<std::size_t> met;
    for (std::size_t i = 0; i < answers.instances.size(); ++i) {
        if (answers.intersects[i]) {
            met.push_back(answers.instances[i]);
        }
    }
    return met;
}

/// No instance intersects: the nearest is that of SeparationQuery, bit for bit.
void check_distance(const Scene& scene, const BatchAnswers& answers, const PlacedRings& placed,
                    const Clearance& clearance) {
    const auto nearest = std::min_element(answers.distance.begin(), answers.distance.end());
    if (nearest == answers.distance.end()) {
        EXPECT_EQ(clearance.instance, InstanceHandle());
        EXPECT_EQ(clearance.distance, infinity);
        return;
    }
    EXPECT_EQ(clearance.distance, *nearest);
    const std::size_t expected =
        answers.instances[static_cast<std::size_t>(nearest - answers.distance.begin())];
    EXPECT_EQ(scene.position(clearance.instance), std::optional<std::size_t>(expected));
    const double bound = clearance.error_bound;
    EXPECT_LE(static_cast<double>(placed.distance_from_boundary(wide(clearance.point))), bound);
    EXPECT_LE(
        static_cast<double>(scene.truth(expected).distance_from_boundary(wide(clearance.nearest))),
        bound);
    EXPECT_NEAR(
        static_cast<double>(distance_between(wide(clearance.point), wide(clearance.nearest))),
        clearance.distance, bound);
    const auto [dx, dy] = clearance.direction;
    if (clearance.distance > 0.0) {
        EXPECT_NEAR(std::hypot(dx, dy), 1.0, 1e-14);
        EXPECT_NEAR(clearance.point.x + clearance.distance * dx, clearance.nearest.x, bound);
        EXPECT_NEAR(clearance.point.y + clearance.distance * dy, clearance.nearest.y, bound);
    } else {
        EXPECT_EQ(clearance.direction, Vector2());
    }
}

/// Instances are intersected: the deepest vertex is that of the brute force.
void check_depth(const Scene& scene, const std::vector<std::size_t>& met, const PlacedRings& placed,
                 const Clearance& clearance) {
    Wide deepest = 0.0L;
    for (const std::size_t i : met) {
        deepest = std::max({deepest, scene.truth(i).deepest_vertex(placed),
                            placed.deepest_vertex(scene.truth(i))});
    }
    const double bound = clearance.error_bound;
    EXPECT_LE(clearance.distance, 0.0);
    EXPECT_NEAR(clearance.distance, -static_cast<double>(deepest), bound);
    const auto named = scene.position(clearance.instance);
    ASSERT_TRUE(named.has_value());
    EXPECT_TRUE(std::find(met.begin(), met.end(), *named) != met.end());
    if (clearance.distance == 0.0) {
        EXPECT_EQ(clearance.direction, Vector2());
        return;
    }
    const PlacedRings& other = scene.truth(*named);
    const double depth = -clearance.distance;
    EXPECT_NEAR(
        static_cast<double>(std::max(other.deepest_vertex(placed), placed.deepest_vertex(other))),
        depth, bound);
    // Both points are on the boundaries, one of them a vertex, as far apart as stated.
    const WidePoint point = wide(clearance.point);
    const WidePoint nearest = wide(clearance.nearest);
    EXPECT_LE(static_cast<double>(placed.distance_from_boundary(point)), bound);
    EXPECT_LE(static_cast<double>(other.distance_from_boundary(nearest)), bound);
    EXPECT_NEAR(static_cast<double>(distance_between(point, nearest)), depth, bound);
    // Moved that far, the vertex is on the boundary: the shape goes the way from point to nearest.
    const double dx = (clearance.nearest.x - clearance.point.x) / depth;
    const double dy = (clearance.nearest.y - clearance.point.y) / depth;
    EXPECT_NEAR(dx, clearance.direction.x, 1e-14 + 2.0 * bound / depth);
    EXPECT_NEAR(dy, clearance.direction.y, 1e-14 + 2.0 * bound / depth);
}

/// With limits, the answer is that without them, or a limit.
void check_limits(Scene& scene, const Asked& asked, const WorldFilter& filter, Random& random,
                  std::span<const Pose> poses, std::span<const Clearance> unlimited) {
    ClearanceQuery query{asked.shape};
    const Clearance& some =
        unlimited[static_cast<std::size_t>(random.whole(0, static_cast<int>(poses.size()) - 1))];
    // Sometimes exactly at an answer.
    query.max_clearance =
        random.whole(0, 1) == 0 ? random.scale(0.001, 10.0) : std::abs(some.distance);
    query.min_clearance = random.whole(0, 1) == 0 ? -random.scale(0.001, 1.0) : some.distance;
    if (!(query.min_clearance < query.max_clearance)) {
        query.min_clearance = -infinity;
    }
    std::vector<Clearance> limited(poses.size());
    const Status status = scene.world().find_clearances(query, poses, limited, {.filter = filter});
    ASSERT_TRUE(status.ok()) << status.text();
    for (std::size_t i = 0; i < poses.size(); ++i) {
        SCOPED_TRACE("pose " + std::to_string(i));
        if (unlimited[i].distance <= query.min_clearance) {
            EXPECT_EQ(limited[i].distance, query.min_clearance);
            EXPECT_EQ(limited[i].instance, InstanceHandle());
        } else if (unlimited[i].distance > query.max_clearance) {
            EXPECT_EQ(limited[i].distance, query.max_clearance);
            EXPECT_EQ(limited[i].instance, InstanceHandle());
        } else {
            EXPECT_TRUE(equal(limited[i], unlimited[i]))
                << limited[i].distance << " instead of " << unlimited[i].distance;
        }
    }
}

class WorldPoses : public testing::TestWithParam<int> {
protected:
    void check(Scene& scene, std::uint64_t seed);
};

void WorldPoses::check(Scene& scene, std::uint64_t seed) {
    const Rectangle box = box_of(scene.placements());
    Random random(seed + 1);
    const Asked asked = any_asked(random, scene);
    const WorldFilter filter = any_filter(random, scene);
    const WorldOptions options{.filter = filter};
    const std::vector<Pose> poses = poses_around(random, scene, box, 16);
    std::vector<std::uint8_t> intersects(poses.size(), 7);
    std::vector<Clearance> clearances(poses.size());
    InstanceLists lists;
    World& world = scene.world();
    ASSERT_TRUE(world.test_poses(asked.shape, poses, intersects, options).ok());
    ASSERT_TRUE(world.find_overlaps(asked.shape, poses, lists, options).ok());
    ASSERT_TRUE(world.find_clearances({asked.shape}, poses, clearances, options).ok());
    ASSERT_EQ(lists.offsets.size(), poses.size() + 1);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        SCOPED_TRACE("pose " + std::to_string(i));
        const PlacedRings placed(asked.rings, poses[i]);
        const BatchAnswers answers =
            ask_batch(scene, {asked.shape, poses[i]}, placed.magnitude(), filter);
        const std::vector<std::size_t> expected = met(answers);
        std::vector<std::size_t> listed;
        for (std::uint32_t k = lists.offsets[i]; k < lists.offsets[i + 1]; ++k) {
            listed.push_back(*scene.position(lists.instances[k]));
        }
        EXPECT_EQ(listed, expected);
        EXPECT_EQ(intersects[i], expected.empty() ? 0 : 1);
        if (expected.empty()) {
            check_distance(scene, answers, placed, clearances[i]);
        } else {
            check_depth(scene, expected, placed, clearances[i]);
        }
    }
    check_limits(scene, asked, filter, random, poses, clearances);
}

TEST_P(WorldPoses, AreAnsweredAsByABatchAndByTheBruteForce) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(4); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 43U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        check(scene, seed);
        if (HasFatalFailure() || HasNonfatalFailure()) {
            return;
        }
    }
}

/// Paths through a box, in short steps: what is known of one pose helps with the next.
std::vector<Pose> paths_through(Random& random, const Scene& scene, const Rectangle& box) {
    std::vector<Pose> poses;
    for (int path = 0; path < 4; ++path) {
        Pose pose{any_point(random, scene, box), random.between(-7.0, 7.0)};
        const double step = random.scale(1e-3, 0.1) * (box.max.x - box.min.x);
        const double turn = random.whole(0, 1) * random.between(-0.3, 0.3);
        const auto is_usable = [](double coordinate) {
            return std::abs(coordinate) <= largest_coordinate;
        };
        for (int i = 0; i < 30 && is_usable(pose.translation.x) && is_usable(pose.translation.y);
             ++i) {
            poses.push_back(pose);
            pose.translation.x += step * std::cos(pose.angle);
            pose.translation.y += step * std::sin(pose.angle);
            pose.angle += turn;
        }
    }
    return poses;
}

void check_paths(Scene& scene, std::uint64_t seed) {
    Random random(seed + 1);
    ClearanceQuery query{any_asked(random, scene).shape};
    const WorldOptions options{.filter = any_filter(random, scene)};
    if (random.whole(0, 3) == 0) {
        query.min_clearance = random.whole(0, 1) == 0 ? 0.0 : -random.scale(1e-3, 1.0);
    }
    const std::vector<Pose> poses = paths_through(random, scene, box_of(scene.placements()));
    std::vector<Clearance> on_paths(poses.size());
    ASSERT_TRUE(scene.world().find_clearances(query, poses, on_paths, options).ok());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        Clearance alone;
        ASSERT_TRUE(
            scene.world().find_clearances(query, {&poses[i], 1}, {&alone, 1}, options).ok());
        EXPECT_TRUE(equal(on_paths[i], alone))
            << "pose " << i << ": " << on_paths[i].distance << " instead of " << alone.distance;
    }
}

TEST_P(WorldPoses, AreAnsweredOnPathsAsAlone) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(20); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 47U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        check_paths(scene, seed);
        if (HasFatalFailure() || HasNonfatalFailure()) {
            return;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldPoses, testing::Range(0, scene_kinds));

TEST(WorldClearances, CountAVertexFarFromTheDeepCorner) {
    // The square's upper right corner is 1 deep in the kite, whose tip is 5 deep in the square.
    Scene scene({{"kite", {{{11.0, 9.0}, {11.0, 11.0}, {9.0, 11.0}, {5.0, 5.0}}}, {}}});
    const ShapeHandle square = scene.add_shape(rectangle({0.0, 0.0}, {10.0, 10.0}));
    const Pose pose{};
    Clearance clearance;
    ASSERT_TRUE(scene.world().find_clearances({square}, {&pose, 1}, {&clearance, 1}).ok());
    EXPECT_EQ(clearance.distance, -5.0);
}

TEST(WorldClearances, OfATurnIntoAWall) {
    // A bar that turns about its centre, which does not move, comes out of the free into the wall.
    Scene scene({{"wall", rectangle({2.0, -50.0}, {4.0, 50.0}), {}}});
    const ShapeHandle bar = scene.add_shape(rectangle({-3.0, -0.5}, {3.0, 0.5}));
    const double quarter = std::acos(0.0);
    const std::vector<Pose> poses{{{0.0, 0.0}, quarter}, {{0.0, 0.0}, 0.0}};
    std::vector<Clearance> clearances(2);
    ASSERT_TRUE(scene.world().find_clearances({bar}, poses, clearances).ok());
    EXPECT_NEAR(clearances[0].distance, 1.5, 1e-12);
    EXPECT_NEAR(clearances[1].distance, -1.0, 1e-12);
}

TEST(WorldClearances, OfSquaresAreWholeNumbers) {
    Scene scene({{"square", rectangle({0, 0}, {4, 4}), {}},
                 {"its twin", rectangle({0, 0}, {4, 4}), {}},
                 {"beside", rectangle({0, 0}, {4, 4}), {{10.0, 0.0}}}});
    const ShapeHandle item = scene.add_shape(rectangle({0, 0}, {1, 1}));
    const std::vector<Pose> poses{
        {{6.0, 1.0}},    // 2 from the first, 3 from the last
        {{7.0, 1.0}},    // 3 from the first, 2 from the last
        {{6.5, 1.0}},    // as far from both
        {{4.0, 1.0}},    // touches
        {{3.0, 1.5}},    // its left corners are 1 deep
        {{13.0, 3.5}},   // one corner is 0.5 deep, the one below 0.5 too
        {{-1.0, -1.0}},  // touches at a corner
    };
    const double distances[] = {2.0, 2.0, 2.5, 0.0, -1.0, -0.5, 0.0};
    const std::size_t instances[] = {0, 2, 0, 0, 0, 2, 0};
    std::vector<Clearance> clearances(poses.size());
    ASSERT_TRUE(scene.world().find_clearances({item}, poses, clearances).ok());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_EQ(clearances[i].distance, distances[i]) << i;
        EXPECT_EQ(clearances[i].instance, scene.handle(instances[i])) << i;
    }
    EXPECT_EQ(clearances[0].direction, (Vector2{-1.0, 0.0}));
    EXPECT_EQ(clearances[1].direction, (Vector2{1.0, 0.0}));
    EXPECT_EQ(clearances[4].direction, (Vector2{1.0, 0.0}));
}

TEST(WorldClearances, CountTheVerticesOfTheInstanceToo) {
    // The corner of the large square is 1 deep in the bar, which has no vertex inside it.
    Scene scene({{"spike", {{{0.0, 0.0}, {4.0, -2.0}, {4.0, 2.0}}}, {}}});
    const ShapeHandle bar = scene.add_shape(rectangle({-3.0, -10.0}, {1.0, 10.0}));
    const Pose pose{};
    Clearance clearance;
    ASSERT_TRUE(scene.world().find_clearances({bar}, {&pose, 1}, {&clearance, 1}).ok());
    EXPECT_EQ(clearance.distance, -1.0);
    EXPECT_EQ(clearance.point, (Vector2{1.0, 0.0}));
    EXPECT_EQ(clearance.nearest, (Vector2{0.0, 0.0}));
    EXPECT_EQ(clearance.direction, (Vector2{-1.0, 0.0}));
}

/// What was nearest before is left out, and then gone.
TEST(WorldClearances, DoNotTellOfWhatWasNearestBefore) {
    const Rings square = rectangle({0.0, 0.0}, {1.0, 1.0});
    Scene scene({{"near", square, {{2.0, 0.0}, 0.0}}, {"far", square, {{5.0, 0.0}, 0.0}}});
    const ShapeHandle own = scene.add_shape(square);
    const auto expect = [&](const WorldFilter& filter, InstanceHandle instance, double distance) {
        const Pose pose{};
        Clearance clearance;
        const Status status =
            scene.world().find_clearances({own}, {&pose, 1}, {&clearance, 1}, {.filter = filter});
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(clearance.instance, instance);
        EXPECT_EQ(clearance.distance, distance);
    };
    const InstanceHandle near = scene.handle(0);
    expect({}, near, 1.0);
    expect({.ignored = near}, scene.handle(1), 4.0);
    expect({}, near, 1.0);
    ASSERT_TRUE(scene.world().remove(near).ok());
    expect({}, scene.handle(1), 4.0);
}

}  // namespace
}  // namespace nearfield::test
