#include <gtest/gtest.h>
#include <tests/oracle/boundary.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/oracle/shape_oracle.hpp>
#include <tests/support/polygons.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::oracle {
namespace {

using test::Random;
using test::Rings;

constexpr std::uint64_t points_seed = 20240611;

/// Inside by the winding of angles around each ring, an algorithm different from the oracle's: the
/// parity of the winding number equals the parity of crossings.
bool inside_by_angles(const Rings& rings, const Vector2& p) {
    long turns = 0;
    for (const Ring& ring : rings) {
        double sum = 0.0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2 from = minus(ring[i], p);
            const Vector2 to = minus(ring[(i + 1) % ring.size()], p);
            sum += std::atan2(from.x * to.y - from.y * to.x, dot(from, to));
        }
        turns += std::lround(sum / (2.0 * std::numbers::pi));
    }
    return turns % 2 != 0;
}

/// Distance to the nearest of many points along every edge: never less than the true one.
double distance_by_samples(const Rings& rings, const Vector2& p, int samples) {
    double best = std::numeric_limits<double>::infinity();
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2 along = minus(ring[(i + 1) % ring.size()], ring[i]);
            for (int k = 0; k < samples; ++k) {
                const double t = static_cast<double>(k) / samples;
                best = std::min(best, distance(p, plus(ring[i], times(along, t))));
            }
        }
    }
    return best;
}

TEST(OraclePoints, AgreeWithAnglesAndSamples) {
    Random random(points_seed);
    for (const auto& [name, rings] : test::every_family(points_seed)) {
        SCOPED_TRACE(name);
        const ShapeOracle shape(rings);
        const int samples = shape.size() > 1000 ? 4 : 200;
        for (int i = 0; i < 40; ++i) {
            const Vector2 p{random.between(-1.2, 1.2), random.between(-1.2, 1.2)};
            const Nearest nearest = shape.nearest(p);
            if (nearest.distance > 1e-9) {
                EXPECT_EQ(shape.contains(p), inside_by_angles(rings, p));
            }
            const double sampled = distance_by_samples(rings, p, samples);
            EXPECT_LE(nearest.distance, sampled * (1 + 1e-12));
            EXPECT_GE(nearest.distance, sampled - 2.0 / samples);
            EXPECT_NEAR(distance(p, nearest.point), nearest.distance, 1e-12);
            EXPECT_EQ(shape.signed_distance(p) < 0, shape.contains(p));
        }
    }
}

TEST(OraclePoints, NearestIsTheLeastOverAllEdges) {
    Random random(points_seed);
    for (const auto& [name, rings] : test::every_family(points_seed + 1)) {
        SCOPED_TRACE(name);
        const ShapeOracle shape(rings);
        for (int i = 0; i < 20; ++i) {
            const Vector2 p{random.between(-1.5, 1.5), random.between(-1.5, 1.5)};
            double least = std::numeric_limits<double>::infinity();
            std::size_t within = 0;
            for (std::uint32_t edge = 0; edge < shape.size(); ++edge) {
                const double here = shape.nearest_on_edge(edge, p).distance;
                least = std::min(least, here);
                within += here <= 0.3 ? 1U : 0U;
            }
            EXPECT_EQ(shape.nearest(p).distance, least);
            EXPECT_EQ(shape.edges_within(p, 0.3).size(), within);
        }
    }
}

TEST(OraclePoints, LocalMinimaOfARectangle) {
    // Repeated vertices and a collinear one change nothing.
    const Rings rings{{{0, 0}, {0, 0}, {4, 0}, {4, 2}, {2, 2}, {0, 2}, {0, 0}}};
    const ShapeOracle shape(rings);
    const auto inside = shape.local_minima_within({1.0, 0.5}, 1.6);
    EXPECT_EQ(inside.size(), 3U);  // below, left, above; the right side is too far
    const auto outside = shape.local_minima_within({-1.0, -1.0}, 10.0);
    for (const Nearest& minimum : outside) {
        EXPECT_EQ(minimum.feature.kind, Feature::Kind::vertex);
        EXPECT_EQ(minimum.point, (Vector2{0.0, 0.0}));
    }
    EXPECT_FALSE(outside.empty());
}

TEST(OraclePoints, SurviveAPoseFarAway) {
    Random random(points_seed);
    for (const auto& [name, rings] : test::every_family(points_seed + 2)) {
        SCOPED_TRACE(name);
        const Pose pose{{random.between(-1e6, 1e6), random.between(-1e6, 1e6)},
                        random.between(-4.0, 4.0)};
        const ShapeOracle here(rings);
        const ShapeOracle there(rings, pose);
        for (int i = 0; i < 20; ++i) {
            const Vector2 p{random.between(-1.2, 1.2), random.between(-1.2, 1.2)};
            const double cosine = std::cos(pose.angle);
            const double sine = std::sin(pose.angle);
            const Vector2 moved{cosine * p.x - sine * p.y + pose.translation.x,
                                sine * p.x + cosine * p.y + pose.translation.y};
            EXPECT_NEAR(std::abs(here.signed_distance(p)), std::abs(there.signed_distance(moved)),
                        1e-9);
        }
    }
}

TEST(OraclePoints, DeepestIsAboveSamplesAndReached) {
    Random random(points_seed);
    const auto shapes = test::every_family(points_seed + 3);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        SCOPED_TRACE(shapes[i].name);
        const ShapeOracle a(shapes[i].rings);
        const ShapeOracle b(shapes[(i + 5) % shapes.size()].rings,
                            {{random.between(-0.5, 0.5), 0.1}, random.between(0.0, 6.0)});
        const Deepest deepest = deepest_on_boundary(a, b, 1e-3);
        EXPECT_LE(deepest.upper, std::max(deepest.depth, 0.0) + 1e-3);
        EXPECT_NEAR(b.depth(deepest.point), deepest.depth, 1e-12);
        EXPECT_LE(a.nearest(deepest.point).distance, 1e-12);
        EXPECT_LE(deepest_vertex(a, b).depth, deepest.upper);
        for (const Vector2& p : sample_boundary(a, 0.01, 2000)) {
            ASSERT_LE(b.depth(p), deepest.upper + 1e-12);
        }
    }
}

TEST(OraclePoints, CrossingsLieOnBothBoundaries) {
    const auto shapes = test::every_family(points_seed + 4);
    std::size_t found = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        SCOPED_TRACE(shapes[i].name);
        const ShapeOracle a(shapes[i].rings, {{0.21, 0.13}, 0.4});
        const ShapeOracle b(shapes[(i + 7) % shapes.size()].rings);
        for (const Vector2& p : crossings(a, b, 1000)) {
            ++found;
            ASSERT_LE(a.nearest(p).distance, 1e-12);
            ASSERT_LE(b.nearest(p).distance, 1e-12);
        }
    }
    EXPECT_GT(found, 100U);
    const ShapeOracle square(test::rectangle({0, 0}, {2, 2}));
    const ShapeOracle shifted(test::rectangle({1, 1}, {3, 3}));
    EXPECT_EQ(crossings(square, shifted, 10).size(), 2U);
}

}  // namespace
}  // namespace nearfield::oracle
