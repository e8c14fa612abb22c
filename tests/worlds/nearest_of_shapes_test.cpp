#include "scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nearfield::test {
namespace {

/// The clearances of a shape from each instance that passes, in the order of adding, as if it were
/// alone in the world.
std::vector<std::vector<Clearance>> clearances_from_each(Scene& scene, ShapeHandle shape,
                                                         const WorldFilter& filter,
                                                         std::span<const Pose> poses) {
    std::vector<std::vector<Clearance>> each;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        if (!scene.passes(i, filter)) {
            continue;
        }
        World alone = std::move(*World::create(scene.context()));
        EXPECT_TRUE(alone.add({scene.shape(i), scene.instance(i).pose}).has_value());
        std::vector<Clearance>& clearances = each.emplace_back(poses.size());
        EXPECT_TRUE(alone.find_clearances({shape}, poses, clearances).ok());
        for (Clearance& clearance : clearances) {
            clearance.instance = scene.handle(i);
        }
    }
    return each;
}

/// The distance of one shape from another, by a loop over all their edges and vertices.
double brute_force(const PlacedRings& shape, const PlacedRings& instance, bool is_met) {
    if (is_met) {
        return -static_cast<double>(
            std::max(shape.deepest_vertex(instance), instance.deepest_vertex(shape)));
    }
    Wide least = infinity;
    for (const WideEdge& edge : shape.edges()) {
        for (const WideEdge& other : instance.edges()) {
            least = std::min(least, distance_between(edge, other));
        }
    }
    return static_cast<double>(least);
}

class NearestOfShapes : public testing::TestWithParam<int> {
protected:
    void check(Scene& scene, std::uint64_t seed);
};

void NearestOfShapes::check(Scene& scene, std::uint64_t seed) {
    Random random(seed + 1);
    const Rectangle box = box_of(scene.placements());
    const Rings rings =
        scaled_and_moved(random.whole(0, 2) == 0 ? star(random, random.whole(257, 400), 0.5)
                                                 : any_shape(random).rings,
                         random.scale(0.05, 2.0), {});
    ShapeNearestQuery query{scene.add_shape(rings)};
    const WorldOptions options{.filter = any_filter(random, scene)};
    query.count = static_cast<std::uint32_t>(random.whole(1, static_cast<int>(scene.size()) + 2));
    std::vector<Pose> poses;
    for (int i = 0; i < 8; ++i) {
        poses.push_back({any_point(random, scene, box), random.between(-7.0, 7.0)});
    }
    const auto each = clearances_from_each(scene, query.shape, options.filter, poses);
    if (random.whole(0, 1) == 0 && !each.empty()) {
        // Sometimes exactly at an answer.
        query.max_distance = random.whole(0, 1) == 0 ? random.scale(1e-3, 10.0)
                                                     : std::abs(each.front().front().distance);
    }
    std::vector<Clearance> nearest(poses.size() * query.count);
    const Status status = scene.world().find_nearest(query, poses, nearest, options);
    ASSERT_TRUE(status.ok()) << status.text();
    for (std::size_t i = 0; i < poses.size(); ++i) {
        std::vector<Clearance> expected;
        for (const std::vector<Clearance>& clearances : each) {
            if (clearances[i].distance <= query.max_distance) {
                expected.push_back(clearances[i]);
            }
        }
        std::stable_sort(
            expected.begin(), expected.end(),
            [](const Clearance& a, const Clearance& b) { return a.distance < b.distance; });
        expected.resize(query.count);
        const PlacedRings placed(rings, poses[i]);
        for (std::uint32_t k = 0; k < query.count; ++k) {
            SCOPED_TRACE(testing::Message() << "pose " << i << ", number " << k);
            const Clearance& found = nearest[i * query.count + k];
            ASSERT_TRUE(equal(found, expected[k]))
                << found.distance << " instead of " << expected[k].distance;
            const auto position = scene.position(found.instance);
            if (position && (k < 2 || k + 1 == each.size())) {
                const bool is_met = found.distance <= 0.0;
                EXPECT_NEAR(found.distance, brute_force(placed, scene.truth(*position), is_met),
                            found.error_bound);
            }
        }
    }
}

TEST_P(NearestOfShapes, AreTheClearancesFromEachInstanceInOrder) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(3); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 71U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        check(scene, seed);
        if (HasFatalFailure() || HasNonfatalFailure()) {
            return;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, NearestOfShapes, testing::Range(0, scene_kinds));

/// Four squares in a row, two of them at the same place.
class NearestSquares : public testing::Test {
protected:
    NearestSquares()
        : scene_({{"right", rectangle({0, 0}, {4, 4}), {{10.0, 0.0}}},
                  {"left", rectangle({0, 0}, {4, 4}), {}},
                  {"its twin", rectangle({0, 0}, {4, 4}), {}},
                  {"far", rectangle({0, 0}, {4, 4}), {{30.0, 0.0}}}}),
          item_(scene_.add_shape(rectangle({0, 0}, {1, 1}))) {}

    std::vector<Clearance> find(const ShapeNearestQuery& query, const Pose& pose) {
        std::vector<Clearance> nearest(query.count);
        EXPECT_TRUE(scene_.world().find_nearest(query, {&pose, 1}, nearest).ok());
        return nearest;
    }

    Scene scene_;
    ShapeHandle item_;
};

TEST_F(NearestSquares, AreInOrderOfDistanceThenOfAdding) {
    const auto expect = [&](const Pose& pose,
                            std::vector<std::pair<std::size_t, double>> expected) {
        for (std::uint32_t count = 1; count <= 4; ++count) {
            const std::vector<Clearance> nearest = find({item_, count}, pose);
            for (std::uint32_t k = 0; k < count; ++k) {
                EXPECT_EQ(nearest[k].instance, scene_.handle(expected[k].first)) << count << k;
                EXPECT_EQ(nearest[k].distance, expected[k].second) << count << k;
            }
        }
    };
    expect({{6.0, 1.0}}, {{1, 2.0}, {2, 2.0}, {0, 3.0}, {3, 23.0}});
    expect({{6.5, 1.0}}, {{0, 2.5}, {1, 2.5}, {2, 2.5}, {3, 22.5}});
    expect({{13.0, 1.5}}, {{0, -1.0}, {1, 9.0}, {2, 9.0}, {3, 16.0}});
    expect({{4.0, 1.0}}, {{1, 0.0}, {2, 0.0}, {0, 5.0}, {3, 25.0}});
    const std::vector<Clearance> nearest = find({item_, 2}, {{6.0, 1.0}});
    EXPECT_EQ(nearest[0].direction, (Vector2{-1.0, 0.0}));
    EXPECT_EQ(nearest[0].point.x, 6.0);
    EXPECT_EQ(nearest[0].nearest.x, 4.0);
}

/// However a search comes to them: the instance added first is left of the shape, or right of it.
TEST(NearestOfTwoSquares, AreInOrderOfAddingOnEitherSide) {
    for (const bool is_left_first : {true, false}) {
        const Placement left{"left", rectangle({0, 0}, {4, 4}), {}};
        const Placement right{"right", rectangle({0, 0}, {4, 4}), {{10.0, 0.0}}};
        Scene scene(is_left_first ? std::vector{left, right} : std::vector{right, left});
        ShapeNearestQuery query{scene.add_shape(rectangle({0, 0}, {1, 1}))};
        const Pose between{{6.5, 1.0}};
        for (query.count = 1; query.count <= 2; ++query.count) {
            std::vector<Clearance> nearest(query.count);
            ASSERT_TRUE(scene.world().find_nearest(query, {&between, 1}, nearest).ok());
            for (std::size_t k = 0; k < nearest.size(); ++k) {
                EXPECT_EQ(nearest[k].distance, 2.5);
                EXPECT_EQ(nearest[k].instance, scene.handle(k)) << is_left_first << query.count;
            }
        }
    }
}

TEST_F(NearestSquares, BeyondTheLargestDistanceAreNone) {
    for (const double max_distance : {2.0, 2.9, 3.0}) {
        const std::vector<Clearance> nearest = find({item_, 5, max_distance}, {{6.0, 1.0}});
        const std::size_t within = max_distance < 3.0 ? 2 : 3;
        for (std::size_t k = 0; k < nearest.size(); ++k) {
            EXPECT_EQ(nearest[k].instance == InstanceHandle(), k >= within) << max_distance << k;
            EXPECT_EQ(nearest[k].distance == infinity, k >= within);
        }
    }
    // What is intersected is not far away, however deep.
    EXPECT_EQ(find({item_, 1, 0.0}, {{1.5, 1.5}})[0].distance, -1.5);
}

TEST_F(NearestSquares, TheFirstIsTheClearance) {
    Random random(3);
    for (int i = 0; i < 50; ++i) {
        const Pose pose{{random.between(-3.0, 17.0), random.between(-3.0, 6.0)},
                        random.between(-3.0, 3.0)};
        Clearance clearance;
        ASSERT_TRUE(scene_.world().find_clearances({item_}, {&pose, 1}, {&clearance, 1}).ok());
        EXPECT_TRUE(equal(find({item_, 3}, pose)[0], clearance));
    }
}

TEST_F(NearestSquares, AreRefusedWithoutRoomOrReason) {
    const std::vector<Pose> poses(3);
    const auto expect = [&](const ShapeNearestQuery& query, std::size_t room,
                            std::span<const Pose> asked, StatusCode code, const char* words,
                            const WorldOptions& options = {}) {
        std::vector<Clearance> nearest(room);
        const Status status = scene_.world().find_nearest(query, asked, nearest, options);
        EXPECT_EQ(status.code(), code);
        EXPECT_NE(status.message().find("find_nearest"), std::string::npos) << status.text();
        EXPECT_NE(status.message().find(words), std::string::npos) << status.text();
    };
    constexpr StatusCode invalid = StatusCode::invalid_query;
    expect({item_, 2}, 5, poses, invalid, "3 poses");
    expect({item_, 2}, 7, poses, invalid, "3 poses");
    expect({item_, 0}, 0, poses, invalid, "0 hits");
    expect({item_, 1, -1.0}, 3, poses, invalid, "at least 0");
    expect({item_, 1, std::numeric_limits<double>::quiet_NaN()}, 3, poses, invalid, "at least 0");
    expect({ShapeHandle()}, 3, poses, StatusCode::unknown_shape, "");
    const std::vector<Pose> bad{{}, {{infinity, 0.0}}};
    expect({item_}, 2, bad, invalid, "number 1");
    Scene other({{"elsewhere", rectangle({0, 0}, {1, 1}), {}}});
    expect({item_}, 3, poses, StatusCode::unknown_instance, "another world",
           {.filter = {.ignored = other.handle(0)}});
}

}  // namespace
}  // namespace nearfield::test
