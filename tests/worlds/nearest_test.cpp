#include "scene.hpp"

#include <gtest/gtest.h>
#include <tests/support/numbers.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace nearfield::test {
namespace {

/// What can be found, and how far it is by brute force.
struct Candidate {
    Wide distance;
    std::size_t instance;
    std::uint32_t edge = 0;
};

/// Instances or edges in order; `distance_of` is called with an instance's rings or with an edge.
template <class Distance>
std::vector<Candidate> candidates_of(const Scene& scene, NearestKind kind,
                                     const WorldFilter& filter, const Distance& distance_of) {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        if (!scene.passes(i, filter)) {
            continue;
        }
        const PlacedRings& truth = scene.truth(i);
        if (kind == NearestKind::instances) {
            candidates.push_back({distance_of(truth), i});
        } else {
            for (std::uint32_t edge = 0; edge < truth.edges().size(); ++edge) {
                candidates.push_back({distance_of(truth.edges()[edge]), i, edge});
            }
        }
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    return candidates;
}

/// From a point.
struct OfPoint {
    WidePoint point;

    Wide operator()(const PlacedRings& instance) const { return instance.signed_distance(point); }
    Wide operator()(const WideEdge& edge) const { return distance_from(edge, point); }
};

/// From a shape.
struct OfShape {
    const PlacedRings& shape;

    Wide operator()(const PlacedRings& /*instance*/) const { return 0; }  // see NearestOfShapes
    Wide operator()(const WideEdge& edge) const {
        if (shape.signed_distance(edge.from) <= 0) {
            return 0;
        }
        Wide least = infinity;
        for (const WideEdge& own : shape.edges()) {
            least = std::min(least, distance_between(own, edge));
        }
        return least;
    }
};

/// What a hit names, among the candidates of its instance.
std::uint32_t named(const NearestHit& /*hit*/) {
    return 0;
}
std::uint32_t named(const ShapeEdgeHit& hit) {
    return hit.edge;
}

/// The places that are named lie where they should, as far from each other as stated.
void check_hit(const Scene& scene, NearestKind kind, const OfPoint& of, const NearestHit& hit) {
    const PlacedRings& truth = scene.truth(*scene.position(hit.instance));
    const double bound = hit.error_bound;
    if (kind == NearestKind::instances) {
        EXPECT_NEAR(static_cast<double>(of(truth)), hit.distance, bound);
    } else {
        EXPECT_GE(hit.distance, 0.0);
    }
    EXPECT_NEAR(static_cast<double>(distance_between(wide(hit.nearest), of.point)),
                std::abs(hit.distance), bound);
    ASSERT_LT(hit.feature.index, truth.edges().size());
    const Wide off = hit.feature.kind == Feature::Kind::edge
                         ? distance_from(truth.edges()[hit.feature.index], wide(hit.nearest))
                         : distance_between(truth.vertices()[hit.feature.index], wide(hit.nearest));
    EXPECT_LE(static_cast<double>(off), bound);
}
void check_hit(const Scene& scene, NearestKind /*kind*/, const OfShape& of,
               const ShapeEdgeHit& hit) {
    const PlacedRings& truth = scene.truth(*scene.position(hit.instance));
    ASSERT_LT(hit.edge, truth.edges().size());
    const WideEdge& edge = truth.edges()[hit.edge];
    EXPECT_NEAR(static_cast<double>(of(edge)), hit.distance, hit.error_bound);
    EXPECT_LE(static_cast<double>(distance_from(edge, wide(hit.nearest))), hit.error_bound);
    EXPECT_LE(static_cast<double>(of.shape.signed_distance(wide(hit.point))), hit.error_bound);
    EXPECT_NEAR(static_cast<double>(distance_between(wide(hit.point), wide(hit.nearest))),
                hit.distance, hit.error_bound);
    if (hit.distance > 0.0) {
        EXPECT_NEAR(std::hypot(hit.direction.x, hit.direction.y), 1.0, 1e-12);
    } else {
        EXPECT_EQ(hit.direction, Vector2());
        EXPECT_EQ(hit.point, hit.nearest);
    }
}

/// What was asked, and the coordinates that rounding is relative to.
struct NearestAsked {
    NearestKind kind;
    double max_distance;
    WorldFilter filter;
    double magnitude;
};

/// The k-th nearest is as far away as the k-th of the brute force, up to the bound; and so is each
/// that is named.
template <class Of, class Hit>
void check_nearest(const Scene& scene, const NearestAsked& asked, const Of& of,
                   std::span<const Hit> hits) {
    const auto found = static_cast<std::size_t>(
        std::find_if(hits.begin(), hits.end(),
                     [](const Hit& hit) { return hit.instance == InstanceHandle(); }) -
        hits.begin());
    for (std::size_t i = found; i < hits.size(); ++i) {
        EXPECT_EQ(hits[i].instance, InstanceHandle());
        EXPECT_EQ(hits[i].distance, infinity);
    }
    constexpr bool names_edges = std::is_same_v<Hit, ShapeEdgeHit>;
    std::set<std::pair<std::size_t, std::uint32_t>> seen;
    std::tuple<double, std::size_t, std::uint32_t> last(-infinity, 0, 0);
    double bound = 0.0;
    for (const Hit& hit : hits.first(found)) {
        const auto here = scene.position(hit.instance);
        ASSERT_TRUE(here.has_value());
        EXPECT_TRUE(scene.passes(*here, asked.filter));
        if (asked.kind == NearestKind::instances || names_edges) {
            EXPECT_TRUE(seen.insert({*here, named(hit)}).second) << "instance " << *here;
        }
        const std::tuple key(hit.distance, *here, named(hit));
        EXPECT_LE(last, key) << "not in order";
        last = key;
        EXPECT_LE(std::abs(hit.distance), asked.max_distance);
        bound = std::max(bound, hit.error_bound);
        check_hit(scene, asked.kind, of, hit);
    }
    // Those within the largest distance up to rounding, of which the hits are the first.
    std::vector<Candidate> candidates = candidates_of(scene, asked.kind, asked.filter, of);
    const double slack = bound + 1e-15 * (scene.truth(0).magnitude() + asked.magnitude);
    std::erase_if(candidates, [&](const Candidate& candidate) {
        return std::abs(candidate.distance) > asked.max_distance + slack;
    });
    const auto certain = static_cast<std::size_t>(
        std::count_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
            return std::abs(candidate.distance) < asked.max_distance - slack;
        }));
    EXPECT_GE(found, std::min<std::size_t>(hits.size(), certain));
    EXPECT_LE(found, candidates.size());
    if (certain == candidates.size()) {
        for (std::size_t i = 0; i < std::min(found, candidates.size()); ++i) {
            EXPECT_NEAR(static_cast<double>(candidates[i].distance), hits[i].distance, bound) << i;
        }
    }
}

using WorldNearest = ScenesTest;

TEST_P(WorldNearest, OfPointsAreThoseOfTheBruteForce) {
    for_each_scene(4, 17, [](Scene& scene, Random& random) {
        const Rectangle box = scene.box();
        for (int asked = 0; asked < 6; ++asked) {
            NearestQuery query;
            query.kind = random.whole(0, 1) == 0 ? NearestKind::instances : NearestKind::edges;
            query.count =
                random.whole(0, 2) == 0 ? 1 : static_cast<std::uint32_t>(random.whole(2, 20));
            query.max_distance = random.whole(0, 2) > 0 ? infinity : random.scale(1e-3, 10.0);
            const WorldOptions options{.filter = any_filter(random, scene)};
            std::vector<Vector2> points(12);
            for (Vector2& point : points) {
                point = any_point(random, scene, box);
            }
            std::vector<NearestHit> hits(points.size() * query.count);
            const Status status = scene.world().find_nearest(query, points, hits, options);
            ASSERT_TRUE(status.ok()) << status.text();
            for (std::size_t i = 0; i < points.size() && !HasFailure(); ++i) {
                SCOPED_TRACE("query " + std::to_string(asked) + ", point " + std::to_string(i));
                check_nearest<OfPoint, NearestHit>(
                    scene,
                    {query.kind, query.max_distance, options.filter,
                     std::abs(points[i].x) + std::abs(points[i].y)},
                    {wide(points[i])}, std::span(hits).subspan(i * query.count, query.count));
            }
        }
    });
}

TEST_P(WorldNearest, EdgesOfShapesAreThoseOfTheBruteForce) {
    for_each_scene(3, 73, [](Scene& scene, Random& random) {
        const Rectangle box = scene.box();
        const Rings rings = scaled_and_moved(any_shape(random).rings, random.scale(0.05, 2.0), {});
        ShapeEdgeQuery query{scene.add_shape(rings)};
        const WorldOptions options{.filter = any_filter(random, scene)};
        for (int i = 0; i < 4 && !HasFailure(); ++i) {
            query.count = static_cast<std::uint32_t>(random.whole(1, 12));
            query.max_distance = random.whole(0, 2) > 0 ? infinity : random.scale(1e-3, 10.0);
            const Pose pose{any_point(random, scene, box), random.between(-7.0, 7.0)};
            std::vector<ShapeEdgeHit> hits(query.count);
            const Status status = scene.world().find_nearest(query, {&pose, 1}, hits, options);
            ASSERT_TRUE(status.ok()) << status.text();
            const PlacedRings shape(rings, pose);
            check_nearest<OfShape, ShapeEdgeHit>(
                scene, {NearestKind::edges, query.max_distance, options.filter, shape.magnitude()},
                {shape}, hits);
        }
    });
}

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

/// WorldPoses compares clearances with the brute force.
TEST_P(WorldNearest, InstancesOfShapesAreInTheOrderOfTheirClearances) {
    for_each_scene(3, 71, [](Scene& scene, Random& random) {
        const Rectangle box = scene.box();
        ShapeNearestQuery query{any_asked(random, scene).shape};
        const WorldOptions options{.filter = any_filter(random, scene)};
        query.count =
            static_cast<std::uint32_t>(random.whole(1, static_cast<int>(scene.size()) + 2));
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
        std::vector<Clearance> first(poses.size());
        ASSERT_TRUE(scene.world().find_clearances({query.shape}, poses, first, options).ok());
        for (std::size_t i = 0; i < poses.size() && !HasFailure(); ++i) {
            std::vector<Clearance> expected;
            for (const std::vector<Clearance>& clearances : each) {
                if (clearances[i].distance <= query.max_distance) {
                    expected.push_back(clearances[i]);
                }
            }
            std::stable_sort(
                expected.begin(), expected.end(),
                [](const Clearance& a, const Clearance& b) { return a.distance < b.distance; });
            if (!expected.empty()) {
                EXPECT_EQ(numbers_of(first[i]), numbers_of(expected.front())) << "pose " << i;
            }
            expected.resize(query.count);
            for (std::uint32_t k = 0; k < query.count; ++k) {
                EXPECT_EQ(numbers_of(nearest[i * query.count + k]), numbers_of(expected[k]))
                    << "pose " << i << ", number " << k;
            }
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldNearest, testing::ValuesIn(all_scene_kinds()));

TEST(WorldNearestTies, GoToTheInstanceAddedFirst) {
    // Four squares around (0, 0), and the last two once more.
    Scene scene(unit_squares({{1, 1}, {-2, 1}, {-2, -2}, {1, -2}, {-2, -2}, {1, -2}}));
    for (std::uint32_t count = 1; count <= 7; ++count) {
        NearestQuery query;
        query.count = count;
        std::vector<NearestHit> hits(count);
        const Vector2 origin{};
        ASSERT_TRUE(scene.world().find_nearest(query, {&origin, 1}, hits).ok());
        for (std::uint32_t i = 0; i < std::min(count, 6U); ++i) {
            EXPECT_EQ(scene.position(hits[i].instance), std::optional<std::size_t>(i)) << count;
            EXPECT_EQ(hits[i].distance, std::sqrt(2.0));
            EXPECT_EQ(hits[i].feature.kind, Feature::Kind::vertex);
        }
        if (count == 7) {
            EXPECT_EQ(hits[6].instance, InstanceHandle());
        }
    }
}

TEST(WorldNearestTies, GoToTheEdgeOfLowestIndex) {
    Scene scene(unit_squares({{0, 0}, {0, 0}}));
    NearestQuery query;
    query.kind = NearestKind::edges;
    for (std::uint32_t count = 1; count <= 8; ++count) {
        query.count = count;
        std::vector<NearestHit> hits(count);
        const Vector2 middle{0.5, 0.5};
        ASSERT_TRUE(scene.world().find_nearest(query, {&middle, 1}, hits).ok());
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_EQ(scene.position(hits[i].instance), std::optional<std::size_t>(i / 4));
            EXPECT_EQ(hits[i].distance, 0.5);
            EXPECT_EQ(hits[i].feature.kind, Feature::Kind::edge);
            EXPECT_EQ(hits[i].feature.index, i % 4) << count << ' ' << i;
        }
    }
}

TEST(WorldNearestTies, WithinAnInstanceGoToTheEdgeOfLowestIndex) {
    Scene scene(unit_squares({{0, 0}}));
    NearestHit hit;
    const Vector2 middle{0.5, 0.5};
    ASSERT_TRUE(scene.world().find_nearest({}, {&middle, 1}, {&hit, 1}).ok());
    EXPECT_EQ(hit.distance, -0.5);
    EXPECT_EQ(hit.feature.kind, Feature::Kind::edge);
    EXPECT_EQ(hit.feature.index, 0U);
}

TEST(WorldNearestTies, HaveThoseInsideFirstTheDeepestAtTheHead) {
    std::vector<Placement> placements = unit_squares({{3, 0}, {0, 0}});
    placements.push_back({"large", rectangle({-5.0, -5.0}, {6.0, 6.0}), {}});
    Scene scene(placements);
    NearestQuery query;
    query.count = 3;
    std::vector<NearestHit> hits(3);
    const Vector2 point{0.5, 0.5};
    ASSERT_TRUE(scene.world().find_nearest(query, {&point, 1}, hits).ok());
    EXPECT_EQ(hits[0].distance, -5.5);
    EXPECT_EQ(hits[1].distance, -0.5);
    EXPECT_EQ(hits[2].distance, 2.5);
    EXPECT_EQ(hits[2].instance, scene.handle(0));
    query.max_distance = 2.5;  // the boundary of the large one is farther away
    ASSERT_TRUE(scene.world().find_nearest(query, {&point, 1}, hits).ok());
    EXPECT_EQ(hits[0].instance, scene.handle(1));
    EXPECT_EQ(hits[1].instance, scene.handle(0));
    EXPECT_EQ(hits[2].instance, InstanceHandle());
}

/// However a search comes to them: the instance added first is left of the shape, or right of it.
TEST(WorldNearestTies, OfShapesGoToTheInstanceAddedFirstOnEitherSide) {
    for (const bool is_left_first : {true, false}) {
        Scene scene(is_left_first ? unit_squares({{0, 0}, {7, 0}})
                                  : unit_squares({{7, 0}, {0, 0}}));
        ShapeNearestQuery query{scene.add_shape(rectangle({0, 0}, {1, 1}))};
        const Pose between{{3.5, 0.25}};
        for (query.count = 1; query.count <= 2; ++query.count) {
            std::vector<Clearance> nearest(query.count);
            ASSERT_TRUE(scene.world().find_nearest(query, {&between, 1}, nearest).ok());
            for (std::size_t k = 0; k < nearest.size(); ++k) {
                EXPECT_EQ(nearest[k].distance, 2.5);
                EXPECT_EQ(nearest[k].instance, scene.handle(k)) << is_left_first << query.count;
            }
        }
        Clearance first;
        ASSERT_TRUE(scene.world().find_clearances({query.shape}, {&between, 1}, {&first, 1}).ok());
        EXPECT_EQ(first.instance, scene.handle(0));
    }
}

/// Two squares of side 4, ten apart, and a small square inside the first, or a large one over both
/// but for the right side of the second.
TEST(WorldNearestTies, OfShapesGoToTheEdgeAddedFirst) {
    Scene scene({{"left", rectangle({0, 0}, {4, 4}), {}},
                 {"right", rectangle({0, 0}, {4, 4}), {{10.0, 0.0}}}});
    const auto expect = [&](const Rings& rings,
                            std::vector<std::pair<std::uint32_t, double>> edges) {
        ShapeEdgeQuery query{scene.add_shape(rings)};
        const Pose pose{};
        for (query.count = 1; query.count <= edges.size(); ++query.count) {
            std::vector<ShapeEdgeHit> hits(query.count);
            ASSERT_TRUE(scene.world().find_nearest(query, {&pose, 1}, hits).ok());
            for (std::size_t k = 0; k < hits.size(); ++k) {
                EXPECT_EQ(hits[k].instance, scene.handle(k / 4));
                EXPECT_EQ(hits[k].edge, edges[k].first) << query.count << ' ' << k;
                EXPECT_EQ(hits[k].distance, edges[k].second) << query.count << ' ' << k;
            }
        }
        // Up to the largest distance itself.
        query.count = static_cast<std::uint32_t>(edges.size());
        query.max_distance = edges.back().second;
        std::vector<ShapeEdgeHit> hits(query.count);
        ASSERT_TRUE(scene.world().find_nearest(query, {&pose, 1}, hits).ok());
        EXPECT_EQ(hits.back().distance, query.max_distance);
        query.max_distance -= 0.01;
        ASSERT_TRUE(scene.world().find_nearest(query, {&pose, 1}, hits).ok());
        EXPECT_EQ(hits.back().instance, InstanceHandle());
    };
    expect(rectangle({1, 1.5}, {2, 2.5}), {{3, 1.0}, {0, 1.5}, {2, 1.5}, {1, 2.0}});
    expect(rectangle({-1, -1}, {12, 5}),
           {{0, 0.0}, {1, 0.0}, {2, 0.0}, {3, 0.0}, {0, 0.0}, {2, 0.0}, {3, 0.0}, {1, 2.0}});
}

/// They are sorted in blocks of 2^18.
TEST(WorldNearestPoints, OfManyBlocksAreWhereTheyWereAsked) {
    Scene scene(unit_squares({{0, 0}, {3, 0}, {0, 3}, {3, 3}}));
    Random random(91);
    std::vector<Vector2> points((1U << 19U) + 100);
    for (Vector2& point : points) {
        point = {random.between(-2.0, 6.0), random.between(-2.0, 6.0)};
    }
    std::vector<NearestHit> hits(points.size());
    ASSERT_TRUE(scene.world().find_nearest({}, points, hits).ok());
    for (std::size_t i = 0; i < points.size(); i += 1 + i / 100) {
        NearestHit alone;
        ASSERT_TRUE(scene.world().find_nearest({}, {&points[i], 1}, {&alone, 1}).ok());
        ASSERT_EQ(hits[i].instance, alone.instance) << i;
        ASSERT_EQ(hits[i].distance, alone.distance) << i;
    }
    for (std::size_t i = points.size() - 100; i < points.size(); ++i) {
        ASSERT_NE(hits[i].instance, InstanceHandle()) << i;
    }
}

}  // namespace
}  // namespace nearfield::test
