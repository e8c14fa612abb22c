#include "scene.hpp"

#include <gtest/gtest.h>
#include <tests/support/numbers.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace nearfield::test {
namespace {

double dot(const Vector2& a, const Vector2& b) {
    return a.x * b.x + a.y * b.y;
}

WideEdge path_of(const Segment& segment) {
    return {wide(segment.from), wide(segment.to)};
}

/// The hit is where it says it is.
void check_hit(const Scene& scene, const Segment& segment, const RayHit& hit) {
    const auto here = scene.position(hit.instance);
    ASSERT_TRUE(here.has_value());
    const PlacedRings& truth = scene.truth(*here);
    ASSERT_LT(hit.edge, truth.edges().size());
    const WideEdge& edge = truth.edges()[hit.edge];
    EXPECT_GE(hit.parameter, 0.0);
    EXPECT_LE(hit.parameter, 1.0);
    const WideEdge path = path_of(segment);
    const WidePoint at{path.from.x + hit.parameter * (path.to.x - path.from.x),
                       path.from.y + hit.parameter * (path.to.y - path.from.y)};
    EXPECT_LE(static_cast<double>(distance_between(at, wide(hit.point))), hit.error_bound);
    EXPECT_LE(static_cast<double>(distance_from(edge, wide(hit.point))), hit.error_bound)
        << scene.placements()[*here].name << " edge " << hit.edge;
    const Vector2 way{segment.to.x - segment.from.x, segment.to.y - segment.from.y};
    const double length = std::hypot(way.x, way.y);
    EXPECT_NEAR(std::hypot(hit.normal.x, hit.normal.y), 1.0, 1e-14)
        << scene.placements()[*here].name << " edge " << hit.edge;
    EXPECT_LE(dot(hit.normal, way), 1e-15 * length);
    const Wide edge_length = distance_between(edge.from, edge.to);
    const Wide along = (edge.to.x - edge.from.x) * static_cast<Wide>(hit.normal.x) +
                       (edge.to.y - edge.from.y) * static_cast<Wide>(hit.normal.y);
    if (edge_length > 0.0L) {
        EXPECT_LE(std::abs(static_cast<double>(along)), 2.0 * hit.error_bound + 1e-15);
    }
}

/// Every edge that is certainly crossed is hit, where it is crossed, and so is every edge of which
/// a vertex lies on the path.
void check_complete(const Scene& scene, const Segment& segment, const WorldFilter& filter,
                    std::span<const RayHit> hits) {
    const WideEdge path = path_of(segment);
    const Wide length = distance_between(path.from, path.to);
    std::set<std::pair<std::size_t, std::uint32_t>> seen;
    for (const RayHit& hit : hits) {
        const std::size_t here = *scene.position(hit.instance);
        EXPECT_TRUE(seen.insert({here, hit.edge}).second) << "edge " << hit.edge << " twice";
        EXPECT_TRUE(scene.passes(here, filter));
    }
    for (std::size_t i = 0; i < scene.size(); ++i) {
        if (!scene.passes(i, filter)) {
            continue;
        }
        const auto edges = scene.truth(i).edges();
        for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
            const Crossing crossing = crossing_of(path, edges[edge]);
            if (!crossing.is_proper) {
                continue;
            }
            EXPECT_EQ(seen.count({i, edge}), 1U)
                << scene.placements()[i].name << ' ' << i << ": edge " << edge << " is crossed at "
                << static_cast<double>(crossing.parameter);
            for (const RayHit& hit : hits) {
                if (scene.position(hit.instance) == i && hit.edge == edge) {
                    const Wide off = std::abs(crossing.parameter - hit.parameter) * length;
                    EXPECT_LE(static_cast<double>(off * crossing.sine), 2.0 * hit.error_bound);
                }
            }
        }
    }
}

void check_segment(const Scene& scene, const Segment& segment, const WorldFilter& filter,
                   std::span<const RayHit> hits, const RayHit& first) {
    check_complete(scene, segment, filter, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        check_hit(scene, segment, hits[i]);
        if (i == 0) {
            continue;
        }
        EXPECT_LE(hits[i - 1].parameter, hits[i].parameter);
        if (hits[i - 1].parameter == hits[i].parameter) {
            EXPECT_LT(std::pair(*scene.position(hits[i - 1].instance), hits[i - 1].edge),
                      std::pair(*scene.position(hits[i].instance), hits[i].edge));
        }
    }
    if (hits.empty()) {
        EXPECT_EQ(first.instance, InstanceHandle());
        EXPECT_EQ(first.parameter, 1.0);
    } else {
        EXPECT_EQ(numbers_of(first), numbers_of(hits.front()));
    }
}

using WorldRays = ScenesTest;

TEST_P(WorldRays, HitWhatTheBruteForceHits) {
    for_each_scene(6, 29, [](Scene& scene, Random& random) {
        const Rectangle box = scene.box();
        const WorldFilter filter = any_filter(random, scene);
        std::vector<Segment> segments(80);
        for (Segment& segment : segments) {
            segment = any_segment(random, scene, box);
        }
        RayHits all;
        std::vector<RayHit> hits(segments.size());
        ASSERT_TRUE(scene.world().cast_rays(segments, all, {.filter = filter}).ok());
        ASSERT_TRUE(scene.world().cast_rays(segments, hits, {.filter = filter}).ok());
        ASSERT_EQ(all.offsets.size(), segments.size() + 1);
        ASSERT_EQ(all.offsets.back(), all.hits.size());
        for (std::size_t i = 0; i < segments.size() && !HasFailure(); ++i) {
            const Segment& s = segments[i];
            SCOPED_TRACE(testing::Message()
                         << std::hexfloat << "segment " << i << ": " << s.from.x << ' ' << s.from.y
                         << " to " << s.to.x << ' ' << s.to.y);
            ASSERT_LE(all.offsets[i], all.offsets[i + 1]);
            const auto of_segment =
                std::span(all.hits).subspan(all.offsets[i], all.offsets[i + 1] - all.offsets[i]);
            check_segment(scene, s, filter, of_segment, hits[i]);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldRays, testing::ValuesIn(all_scene_kinds()));

TEST(WorldRaysThroughVertices, DoNotLeak) {
    Random random(5);
    for (int number = 0; number < random_cases(40); ++number) {
        const double size = random.scale(1e-3, 1e3);
        const Vector2 centre{random.between(-1e6, 1e6), random.between(-1e6, 1e6)};
        const int corners = random.whole(3, 90);
        Scene scene({{"regular polygon",
                      scaled_and_moved(regular(corners), size, {}),
                      {centre, random.between(0.0, 6.0)}}});
        std::vector<Segment> segments;
        for (const WidePoint& vertex : scene.truth(0).vertices()) {
            const Vector2 on{static_cast<double>(vertex.x), static_cast<double>(vertex.y)};
            const Vector2 out{on.x - centre.x, on.y - centre.y};
            // From inside through a vertex, and the same backwards, near and from far away.
            for (const double far : {2.0, 1e3, 1e6 / size}) {
                const Vector2 end{centre.x + far * out.x, centre.y + far * out.y};
                segments.push_back({centre, end});
                segments.push_back({end, centre});
            }
        }
        std::vector<RayHit> hits(segments.size());
        RayHits all;
        ASSERT_TRUE(scene.world().cast_rays(segments, hits).ok());
        ASSERT_TRUE(scene.world().cast_rays(segments, all).ok());
        for (std::size_t i = 0; i < hits.size(); ++i) {
            EXPECT_EQ(hits[i].instance, scene.handle(0))
                << "segment " << i << " of a polygon of " << corners << " and size " << size;
            EXPECT_GE(all.offsets[i + 1] - all.offsets[i], 1U);
        }
    }
}

TEST(WorldRaysOnSquares, HitWholeNumbersExactly) {
    Scene scene({{"square", rectangle({0, 0}, {1, 1}), {{2.0, 0.0}}},
                 {"its twin", rectangle({0, 0}, {1, 1}), {{2.0, 0.0}}},
                 {"its neighbour", rectangle({0, 0}, {1, 1}), {{3.0, 0.0}}}});
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-12; };
    RayHits all;
    // Through the middle: entering, the shared side, leaving.
    const Segment through{{0.0, 0.5}, {8.0, 0.5}};
    ASSERT_TRUE(scene.world().cast_rays({&through, 1}, all).ok());
    ASSERT_EQ(all.hits.size(), 6U);
    const double expected[] = {0.25, 0.25, 0.375, 0.375, 0.375, 0.5};
    const std::size_t instances[] = {0, 1, 0, 1, 2, 2};
    const std::uint32_t edges[] = {3, 3, 1, 1, 3, 1};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_TRUE(near(all.hits[i].parameter, expected[i])) << all.hits[i].parameter;
        EXPECT_EQ(all.hits[i].instance, scene.handle(instances[i])) << i;
        EXPECT_EQ(all.hits[i].edge, edges[i]) << i;
        EXPECT_EQ(all.hits[i].normal, (Vector2{-1.0, 0.0})) << i;
    }
    // Along the lower sides: the left side and the lower one are hit at the corner.
    const Segment along{{0.0, 0.0}, {8.0, 0.0}};
    RayHit hit;
    ASSERT_TRUE(scene.world().cast_rays({&along, 1}, {&hit, 1}).ok());
    EXPECT_EQ(hit.instance, scene.handle(0));
    EXPECT_EQ(hit.edge, 0U);
    EXPECT_TRUE(near(hit.parameter, 0.25)) << hit.parameter;
    // A point on a side, and one inside.
    const Segment points[] = {{{2.5, 0.0}, {2.5, 0.0}}, {{2.5, 0.5}, {2.5, 0.5}}};
    std::vector<RayHit> two(2);
    ASSERT_TRUE(scene.world().cast_rays(points, two).ok());
    EXPECT_EQ(two[0].instance, scene.handle(0));
    EXPECT_EQ(two[0].parameter, 0.0);
    EXPECT_EQ(two[1].instance, InstanceHandle());
}

TEST(WorldRaysInBlocks, KeepTheirOrder) {
    // More than are sorted at a time.
    Scene scene({{"square", rectangle({0, 0}, {1, 1}), {}}});
    Random random(3);
    std::vector<Segment> segments(140'000);
    for (Segment& segment : segments) {
        const double x = random.between(0.0, 1.0);
        segment = {{x, 2.0}, {x, random.between(-2.0, 0.5)}};
    }
    std::vector<RayHit> hits(segments.size());
    ASSERT_TRUE(scene.world().cast_rays(segments, hits).ok());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        ASSERT_NEAR(hits[i].point.x, segments[i].from.x, 1e-12) << i;
        ASSERT_NEAR(hits[i].parameter, 1.0 / (2.0 - segments[i].to.y), 1e-12) << i;
    }
}

TEST(WorldRaysOnRepeatedVertices, HaveANormal) {
    // The edge of lowest index at the corner (0, 0) has no length.
    Scene scene({{"square", {{{0, 0}, {0, 0}, {1, 0}, {1, 1}, {0, 1}}}, {}}});
    const Segment segment{{-1.0, -1.0}, {0.5, 0.5}};
    RayHit hit;
    ASSERT_TRUE(scene.world().cast_rays({&segment, 1}, {&hit, 1}).ok());
    ASSERT_EQ(hit.instance, scene.handle(0));
    EXPECT_NEAR(std::hypot(hit.normal.x, hit.normal.y), 1.0, 1e-15);
}

}  // namespace
}  // namespace nearfield::test
