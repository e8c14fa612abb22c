#include "scene.hpp"

#include <gtest/gtest.h>
#include <tests/support/numbers.hpp>

#include <algorithm>
#include <cmath>

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
            EXPECT_EQ(numbers_of(limited[i]), numbers_of(unlimited[i]));
        }
    }
}

using WorldPoses = ScenesTest;

TEST_P(WorldPoses, AreAnsweredAsByABatchAndByTheBruteForce) {
    for_each_scene(4, 43, [](Scene& scene, Random& random) {
        const Asked asked = any_asked(random, scene);
        const WorldOptions options{.filter = any_filter(random, scene)};
        const std::vector<Pose> poses = poses_around(random, scene, scene.box(), 16);
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
                ask_batch(scene, {asked.shape, poses[i]}, placed.magnitude(), options.filter);
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
        check_limits(scene, asked, options.filter, random, poses, clearances);
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldPoses, testing::ValuesIn(all_scene_kinds()));

TEST(WorldClearances, CountAVertexFarFromTheDeepCorner) {
    // The square's upper right corner is 1 deep in the kite, whose tip is 5 deep in the square.
    Scene scene({{"kite", {{{11.0, 9.0}, {11.0, 11.0}, {9.0, 11.0}, {5.0, 5.0}}}, {}}});
    const ShapeHandle square = scene.add_shape(rectangle({0.0, 0.0}, {10.0, 10.0}));
    const Pose pose{};
    Clearance clearance;
    ASSERT_TRUE(scene.world().find_clearances({square}, {&pose, 1}, {&clearance, 1}).ok());
    EXPECT_EQ(clearance.distance, -5.0);
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

}  // namespace
}  // namespace nearfield::test
