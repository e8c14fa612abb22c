#include "scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace nearfield::test {
namespace {

/// What a point is as far as, by brute force.
struct Candidate {
    Wide distance;
    std::size_t instance;
};

std::vector<Candidate> candidates_of(const Scene& scene, const NearestQuery& query,
                                     const WorldFilter& filter, const Vector2& point) {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        if (!scene.passes(i, filter)) {
            continue;
        }
        if (query.kind == NearestKind::instances) {
            candidates.push_back({scene.truth(i).signed_distance(wide(point)), i});
        } else {
            for (const WideEdge& edge : scene.truth(i).edges()) {
                candidates.push_back({distance_from(edge, wide(point)), i});
            }
        }
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    return candidates;
}

/// The point that is named lies on the feature that is named, and as far away as stated.
void check_place(const Scene& scene, const NearestHit& hit, const Vector2& point) {
    const PlacedRings& truth = scene.truth(*scene.position(hit.instance));
    const double bound = hit.error_bound;
    EXPECT_NEAR(static_cast<double>(distance_between(wide(hit.nearest), wide(point))),
                std::abs(hit.distance), bound);
    ASSERT_LT(hit.feature.index, truth.edges().size());
    const Wide off = hit.feature.kind == Feature::Kind::edge
                         ? distance_from(truth.edges()[hit.feature.index], wide(hit.nearest))
                         : distance_between(truth.vertices()[hit.feature.index], wide(hit.nearest));
    EXPECT_LE(static_cast<double>(off), bound);
}

void check_order(const Scene& scene, const NearestQuery& query, const WorldFilter& filter,
                 std::span<const NearestHit> hits) {
    std::set<std::size_t> seen;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const auto here = scene.position(hits[i].instance);
        ASSERT_TRUE(here.has_value());
        EXPECT_TRUE(scene.passes(*here, filter));
        if (query.kind == NearestKind::instances) {
            EXPECT_TRUE(seen.insert(*here).second) << "instance " << *here << " twice";
        } else {
            EXPECT_GE(hits[i].distance, 0.0);
        }
        if (i > 0) {
            EXPECT_GE(hits[i].distance, hits[i - 1].distance);
            if (hits[i].distance == hits[i - 1].distance) {
                EXPECT_GE(*here, *scene.position(hits[i - 1].instance));
            }
        }
    }
}

/// Compares the hits of a point with the truth. The k-th nearest is as far away as the k-th of the
/// brute force, up to the bound; and so is each that is named.
void check_point(const Scene& scene, const NearestQuery& query, const WorldFilter& filter,
                 const Vector2& point, std::span<const NearestHit> hits) {
    std::vector<Candidate> candidates = candidates_of(scene, query, filter, point);
    const auto found = static_cast<std::size_t>(
        std::find_if(hits.begin(), hits.end(),
                     [](const NearestHit& hit) { return hit.instance == InstanceHandle(); }) -
        hits.begin());
    for (std::size_t i = found; i < hits.size(); ++i) {
        EXPECT_EQ(hits[i].instance, InstanceHandle());
        EXPECT_EQ(hits[i].distance, infinity);
    }
    const std::span<const NearestHit> all = hits.first(found);
    check_order(scene, query, filter, all);
    double bound = 0.0;
    for (const NearestHit& hit : all) {
        EXPECT_LE(std::abs(hit.distance), query.max_distance);
        bound = std::max(bound, hit.error_bound);
        if (query.kind == NearestKind::instances) {
            const std::size_t here = *scene.position(hit.instance);
            EXPECT_NEAR(static_cast<double>(scene.truth(here).signed_distance(wide(point))),
                        hit.distance, hit.error_bound)
                << scene.placements()[here].name << ' ' << here;
        }
        check_place(scene, hit, point);
    }
    // Those within the largest distance up to rounding, of which the hits are the first.
    const double slack = bound + 1e-15 * scene.truth(0).magnitude() +
                         1e-15 * (std::abs(point.x) + std::abs(point.y));
    std::erase_if(candidates, [&](const Candidate& candidate) {
        return std::abs(candidate.distance) > query.max_distance + slack;
    });
    const auto certain = static_cast<std::size_t>(
        std::count_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
            return std::abs(candidate.distance) < query.max_distance - slack;
        }));
    EXPECT_GE(found, std::min<std::size_t>(hits.size(), certain));
    EXPECT_LE(found, candidates.size());
    if (certain == candidates.size()) {
        for (std::size_t i = 0; i < std::min(found, candidates.size()); ++i) {
            EXPECT_NEAR(static_cast<double>(candidates[i].distance), hits[i].distance, bound) << i;
        }
    }
}

NearestQuery any_query(Random& random) {
    NearestQuery query;
    query.kind = random.whole(0, 1) == 0 ? NearestKind::instances : NearestKind::edges;
    query.count = random.whole(0, 2) == 0 ? 1 : static_cast<std::uint32_t>(random.whole(2, 20));
    query.max_distance = random.whole(0, 2) > 0 ? infinity : random.scale(1e-3, 10.0);
    return query;
}

class WorldNearest : public testing::TestWithParam<int> {};

TEST_P(WorldNearest, IsThatOfTheBruteForce) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(4); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 17U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        const Rectangle box = box_of(scene.placements());
        Random random(seed + 1);
        for (int asked = 0; asked < 6; ++asked) {
            const NearestQuery query = any_query(random);
            const WorldOptions options{.filter = any_filter(random, scene)};
            std::vector<Vector2> points(12);
            for (Vector2& point : points) {
                point = any_point(random, scene, box);
            }
            std::vector<NearestHit> hits(points.size() * query.count);
            const Status status = scene.world().find_nearest(query, points, hits, options);
            ASSERT_TRUE(status.ok()) << status.text();
            for (std::size_t i = 0; i < points.size(); ++i) {
                SCOPED_TRACE("query " + std::to_string(asked) + ", point " + std::to_string(i));
                check_point(scene, query, options.filter, points[i],
                            std::span(hits).subspan(i * query.count, query.count));
                if (HasFatalFailure() || HasNonfatalFailure()) {
                    return;
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldNearest, testing::Range(0, scene_kinds));

std::vector<Placement> placed_squares(std::initializer_list<Vector2> corners) {
    std::vector<Placement> placements;
    for (const Vector2& corner : corners) {
        placements.push_back({"unit square", rectangle({0.0, 0.0}, {1.0, 1.0}), {corner, 0.0}});
    }
    return placements;
}

TEST(WorldNearestTies, GoToTheInstanceAddedFirst) {
    // Four placed_squares around (0, 0), and the last two once more.
    Scene scene(placed_squares({{1, 1}, {-2, 1}, {-2, -2}, {1, -2}, {-2, -2}, {1, -2}}));
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
    Scene scene(placed_squares({{0, 0}, {0, 0}}));
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
    Scene scene(placed_squares({{0, 0}}));
    NearestHit hit;
    const Vector2 middle{0.5, 0.5};
    ASSERT_TRUE(scene.world().find_nearest({}, {&middle, 1}, {&hit, 1}).ok());
    EXPECT_EQ(hit.distance, -0.5);
    EXPECT_EQ(hit.feature.kind, Feature::Kind::edge);
    EXPECT_EQ(hit.feature.index, 0U);
}

TEST(WorldNearestTies, HaveThoseInsideFirstTheDeepestAtTheHead) {
    std::vector<Placement> placements = placed_squares({{3, 0}, {0, 0}});
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

/// They are sorted in blocks of 2^18.
TEST(WorldNearestPoints, OfManyBlocksAreWhereTheyWereAsked) {
    Scene scene(placed_squares({{0, 0}, {3, 0}, {0, 3}, {3, 3}}));
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
