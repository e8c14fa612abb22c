#include "scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

/// The distance of an edge from a shape, by a loop over all its edges.
Wide distance_of(const PlacedRings& shape, const WideEdge& edge) {
    if (shape.signed_distance(edge.from) <= 0) {
        return 0;
    }
    Wide least = infinity;
    for (const WideEdge& own : shape.edges()) {
        least = std::min(least, distance_between(own, edge));
    }
    return least;
}

/// The distances of all edges that pass, in ascending order.
std::vector<Wide> distances_of(const Scene& scene, const PlacedRings& shape,
                               const WorldFilter& filter) {
    std::vector<Wide> distances;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        if (scene.passes(i, filter)) {
            for (const WideEdge& edge : scene.truth(i).edges()) {
                distances.push_back(distance_of(shape, edge));
            }
        }
    }
    std::sort(distances.begin(), distances.end());
    return distances;
}

/// A hit says the truth of the edge that it names, and its points lie where they should.
void check_hit(const Scene& scene, const PlacedRings& shape, const ShapeEdgeHit& hit) {
    const std::optional<std::size_t> position = scene.position(hit.instance);
    ASSERT_TRUE(position.has_value());
    const PlacedRings& instance = scene.truth(*position);
    ASSERT_LT(hit.edge, instance.edges().size());
    const WideEdge& edge = instance.edges()[hit.edge];
    EXPECT_NEAR(static_cast<double>(distance_of(shape, edge)), hit.distance, hit.error_bound);
    EXPECT_LE(static_cast<double>(distance_from(edge, wide(hit.nearest))), hit.error_bound);
    EXPECT_LE(static_cast<double>(shape.signed_distance(wide(hit.point))), hit.error_bound);
    EXPECT_NEAR(static_cast<double>(distance_between(wide(hit.point), wide(hit.nearest))),
                hit.distance, hit.error_bound);
    if (hit.distance > 0.0) {
        EXPECT_NEAR(std::hypot(hit.direction.x, hit.direction.y), 1.0, 1e-12);
    } else {
        EXPECT_EQ(hit.direction, Vector2());
    }
}

void check_hits(const Scene& scene, const PlacedRings& shape, const ShapeEdgeQuery& query,
                const WorldFilter& filter, std::span<const ShapeEdgeHit> hits) {
    const std::vector<Wide> truth = distances_of(scene, shape, filter);
    std::set<std::pair<std::size_t, std::uint32_t>> seen;
    std::size_t count = 0;
    double bound = 0.0;
    for (const ShapeEdgeHit& hit : hits) {
        if (hit.instance == InstanceHandle()) {
            EXPECT_EQ(hit.distance, infinity);
            continue;
        }
        check_hit(scene, shape, hit);
        EXPECT_LE(hit.distance, query.max_distance);
        const std::size_t position = scene.position(hit.instance).value();
        EXPECT_TRUE(scene.passes(position, filter));
        EXPECT_TRUE(seen.insert({position, hit.edge}).second);
        if (count > 0) {
            const ShapeEdgeHit& before = hits[count - 1];
            const std::pair here(position, hit.edge);
            const std::pair there(scene.position(before.instance).value(), before.edge);
            EXPECT_TRUE(before.distance < hit.distance ||
                        (before.distance == hit.distance && there < here))
                << count;
        }
        bound = std::max(bound, hit.error_bound);
        ++count;
    }
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_NEAR(static_cast<double>(truth[i]), hits[i].distance, bound) << i;
    }
    if (count < hits.size() && count < truth.size()) {
        const double slack = 1e-15 * (shape.magnitude() + scene.truth(0).magnitude()) + bound;
        EXPECT_GE(static_cast<double>(truth[count]), query.max_distance - slack);
    }
}

class EdgesNearShapes : public testing::TestWithParam<int> {};

TEST_P(EdgesNearShapes, AreThoseOfTheBruteForce) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(3); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 73U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        Random random(seed + 1);
        const Rectangle box = box_of(scene.placements());
        const Rings rings = scaled_and_moved(any_shape(random).rings, random.scale(0.05, 2.0), {});
        ShapeEdgeQuery query{scene.add_shape(rings)};
        const WorldOptions options{.filter = any_filter(random, scene)};
        for (int i = 0; i < 4; ++i) {
            query.count = static_cast<std::uint32_t>(random.whole(1, 12));
            query.max_distance = random.whole(0, 2) > 0 ? infinity : random.scale(1e-3, 10.0);
            const Pose pose{any_point(random, scene, box), random.between(-7.0, 7.0)};
            std::vector<ShapeEdgeHit> hits(query.count);
            const Status status = scene.world().find_nearest(query, {&pose, 1}, hits, options);
            ASSERT_TRUE(status.ok()) << status.text();
            check_hits(scene, PlacedRings(rings, pose), query, options.filter, hits);
            if (HasFatalFailure() || HasNonfatalFailure()) {
                return;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, EdgesNearShapes, testing::Range(0, scene_kinds));

/// Two squares of side 4, ten apart, and a small square.
class EdgesNearSquares : public testing::Test {
protected:
    EdgesNearSquares()
        : scene_({{"left", rectangle({0, 0}, {4, 4}), {}},
                  {"right", rectangle({0, 0}, {4, 4}), {{10.0, 0.0}}}}),
          item_(scene_.add_shape(rectangle({0, 0}, {1, 1}))) {}

    std::vector<ShapeEdgeHit> find(ShapeEdgeQuery query, const Pose& pose) {
        std::vector<ShapeEdgeHit> hits(query.count);
        EXPECT_TRUE(scene_.world().find_nearest(query, {&pose, 1}, hits).ok());
        return hits;
    }
    void expect_edges(const std::vector<ShapeEdgeHit>& hits, std::size_t instance,
                      const std::vector<std::pair<std::uint32_t, double>>& edges) const {
        for (std::size_t i = 0; i < edges.size(); ++i) {
            EXPECT_EQ(hits[i].instance, scene_.handle(instance)) << i;
            EXPECT_EQ(hits[i].edge, edges[i].first) << i;
            EXPECT_EQ(hits[i].distance, edges[i].second) << i;
        }
    }

    Scene scene_;
    ShapeHandle item_;
};

TEST_F(EdgesNearSquares, AreInOrderOfDistanceThenOfAddingThenOfTheRing) {
    expect_edges(find({item_, 4}, {{6.0, 1.0}}), 0,
                 {{1, 2.0}, {0, std::sqrt(5.0)}, {2, std::sqrt(8.0)}});
    const std::vector<ShapeEdgeHit> inside = find({item_, 4}, {{1.0, 1.5}});
    expect_edges(inside, 0, {{3, 1.0}, {0, 1.5}, {2, 1.5}, {1, 2.0}});
    EXPECT_EQ(inside[0].point.x, 1.0);
    EXPECT_EQ(inside[0].nearest.x, 0.0);
    EXPECT_EQ(inside[0].direction, (Vector2{-1.0, 0.0}));
}

TEST_F(EdgesNearSquares, ThatAreCoveredAreAtDistance0) {
    ShapeEdgeQuery query{scene_.add_shape(rectangle({-1, -1}, {12, 5})), 8};
    const std::vector<ShapeEdgeHit> hits = find(query, {});
    expect_edges(hits, 0, {{0, 0.0}, {1, 0.0}, {2, 0.0}, {3, 0.0}});
    expect_edges({hits.begin() + 4, hits.end()}, 1, {{0, 0.0}, {2, 0.0}, {3, 0.0}, {1, 2.0}});
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(hits[i].point, hits[i].nearest) << i;
        EXPECT_EQ(hits[i].distance, 0.0) << i;
    }
}

TEST_F(EdgesNearSquares, BeyondTheLargestDistanceAreNone) {
    EXPECT_EQ(find({item_, 2, 2.0}, {{6.0, 1.0}})[0].edge, 1U);
    EXPECT_EQ(find({item_, 2, 2.0}, {{6.0, 1.0}})[1].instance, InstanceHandle());
    EXPECT_EQ(find({item_, 1, 1.99}, {{6.0, 1.0}})[0].instance, InstanceHandle());
}

TEST_F(EdgesNearSquares, AreRefusedWithoutRoomOrReason) {
    const std::vector<Pose> poses(3);
    const auto code_of = [&](const ShapeEdgeQuery& query, std::size_t room) {
        std::vector<ShapeEdgeHit> hits(room);
        return scene_.world().find_nearest(query, poses, hits).code();
    };
    EXPECT_EQ(code_of({item_, 2}, 5), StatusCode::invalid_query);
    EXPECT_EQ(code_of({item_, 0}, 0), StatusCode::invalid_query);
    EXPECT_EQ(code_of({item_, 1, -1.0}, 3), StatusCode::invalid_query);
    EXPECT_EQ(code_of({ShapeHandle()}, 3), StatusCode::unknown_shape);
    EXPECT_EQ(code_of({item_}, 3), StatusCode::ok);
}

}  // namespace
}  // namespace nearfield::test
