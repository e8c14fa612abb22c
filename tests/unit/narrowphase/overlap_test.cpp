#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/overlap_test.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

/// Every edge against every edge, then every vertex against the other shape.
bool intersect_by_force(const TransformedPolygon& a, const TransformedPolygon& b) {
    const auto edge_end = [](const TransformedPolygon& p, std::uint32_t i) {
        return p.vertex(p.polygon().next(i));
    };
    for (std::uint32_t i = 0; i < a.polygon().size(); ++i) {
        const Vector from = a.vertex(i);
        const Vector to = edge_end(a, i);
        for (std::uint32_t j = 0; j < b.polygon().size(); ++j) {
            if (geometry::segments_intersect(from, to, b.vertex(j), edge_end(b, j))) {
                return true;
            }
        }
    }
    const auto any_inside = [](const TransformedPolygon& inner, const TransformedPolygon& outer) {
        for (std::uint32_t i = 0; i < inner.polygon().size(); ++i) {
            if (contains(outer, inner.vertex(i))) {
                return true;
            }
        }
        return false;
    };
    return any_inside(a, b) || any_inside(b, a);
}

/// By trees, and by brute force where that is for both shapes.
bool intersects(const TransformedPolygon& a, const TransformedPolygon& b) {
    static simd::TransformedInstances instances;
    static OverlapTest test;
    instances.clear();
    const std::uint32_t index_a = instances.place(a);
    const std::uint32_t index_b = instances.place(b);
    const bool are_small = is_small(instances[index_a]) && is_small(instances[index_b]);
    const bool by_force = are_small && test.intersect(instances[index_a], instances[index_b]);
    instances.complete(index_a);
    instances.complete(index_b);
    const bool answer = test.intersect(instances[index_a], instances[index_b]);
    EXPECT_TRUE(!are_small || by_force == answer);
    return answer;
}

TEST(OverlapTest, AgreesWithBruteForce) {
    samples::Random random(1);
    const std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    int together = 0;
    int apart = 0;
    for (const samples::NamedRings& shape_a : shapes) {
        for (const samples::NamedRings& shape_b : shapes) {
            const Polygon a = samples::polygon(shape_a.rings);
            const Polygon b = samples::polygon(shape_b.rings);
            for (int round = 0; round < 12; ++round) {
                const double far = round % 3 == 0 ? 1e6 : 0.0;
                const double angle = random.between(0.0, 2.0 * std::numbers::pi);
                const double distance = random.between(0.0, 2.2);
                const TransformedPolygon transformed_a(a, {{far, far}, random.between(0.0, 6.0)});
                const TransformedPolygon transformed_b(
                    b, {{far + distance * std::cos(angle), far + distance * std::sin(angle)},
                        random.between(0.0, 6.0)});
                const bool expected = intersect_by_force(transformed_a, transformed_b);
                (expected ? together : apart) += 1;
                const std::string what =
                    shape_a.name + " and " + shape_b.name + ", round " + std::to_string(round);
                EXPECT_EQ(intersects(transformed_a, transformed_b), expected) << what;
                EXPECT_EQ(intersects(transformed_b, transformed_a), expected)
                    << what << ", swapped";
            }
        }
    }
    EXPECT_GT(together, 300);
    EXPECT_GT(apart, 300);
}

bool intersect(const samples::Rings& rings_a, const samples::Rings& rings_b,
               const Pose& pose_b = {}) {
    const Polygon a = samples::polygon(rings_a);
    const Polygon b = samples::polygon(rings_b);
    const TransformedPolygon transformed_a(a, {});
    const TransformedPolygon transformed_b(b, pose_b);
    const bool answer = intersects(transformed_a, transformed_b);
    EXPECT_EQ(intersects(transformed_b, transformed_a), answer);
    return answer;
}

TEST(OverlapTest, TouchingCounts) {
    const samples::Rings square{samples::rectangle(0.0, 0.0, 1.0, 1.0)};
    EXPECT_TRUE(intersect(square, {samples::rectangle(1.0, 0.25, 2.0, 0.75)})) << "along an edge";
    EXPECT_TRUE(intersect(square, {samples::rectangle(1.0, 1.0, 2.0, 2.0)})) << "at a corner";
    EXPECT_TRUE(intersect(square, {{{1.0, 0.5}, {2.0, 0.0}, {2.0, 1.0}}})) << "corner on edge";
    EXPECT_TRUE(intersect(square, square)) << "the same";
    EXPECT_FALSE(intersect(square, {samples::rectangle(1.0 + 1e-9, 0.0, 2.0, 1.0)}));
}

TEST(OverlapTest, TouchingCountsWhereRoundingBlursIt) {
    // In exact arithmetic each pair shares a line or a corner; the transformed vertices are
    // rounded.
    samples::Random random(2);
    for (int round = 0; round < 2000; ++round) {
        const double scale = std::pow(10.0, random.between(-3.0, 6.0));
        const double side = scale * random.between(0.1, 1.0);
        const samples::Rings rings{samples::rectangle(0.0, 0.0, side, side)};
        const Polygon polygon = samples::polygon(rings);
        const double angle = random.between(0.0, 6.0);
        const Vector2 at{scale * random.between(-9.0, 9.0), scale * random.between(-9.0, 9.0)};
        const Vector2 beside{at.x + side * std::cos(angle), at.y + side * std::sin(angle)};
        EXPECT_TRUE(intersects(TransformedPolygon(polygon, {at, angle}),
                               TransformedPolygon(polygon, {beside, angle})))
            << round;
        const double gap = side + 1e-12 * scale;
        const Vector2 off{at.x + gap * std::cos(angle), at.y + gap * std::sin(angle)};
        EXPECT_FALSE(intersects(TransformedPolygon(polygon, {at, angle}),
                                TransformedPolygon(polygon, {off, angle})))
            << round;
    }
}

TEST(OverlapTest, ContainmentCountsAndHolesDoNot) {
    const Ring outer = samples::rectangle(0.0, 0.0, 10.0, 10.0);
    const Ring hole = samples::rectangle(1.0, 1.0, 9.0, 9.0);
    const Ring island = samples::rectangle(4.0, 4.0, 6.0, 6.0);
    const samples::Rings in_hole{samples::rectangle(2.0, 2.0, 3.0, 3.0)};
    EXPECT_TRUE(intersect({outer}, in_hole)) << "B in A";
    EXPECT_TRUE(intersect({island}, {outer})) << "A in B";
    EXPECT_FALSE(intersect({outer, hole}, in_hole)) << "in the hole";
    EXPECT_FALSE(intersect({outer, hole, island}, in_hole)) << "between hole and island";
    EXPECT_TRUE(intersect({outer, hole, island}, {samples::rectangle(4.5, 4.5, 5.0, 5.0)}))
        << "in the island";
    EXPECT_TRUE(intersect({outer, hole}, {samples::rectangle(1.0, 4.0, 2.0, 5.0)}))
        << "touches the hole's rim from within";
    EXPECT_TRUE(intersect({samples::rectangle(20.0, 0.0, 21.0, 1.0), outer}, in_hole))
        << "B in a part of A that is not its first";
    EXPECT_TRUE(intersect({outer}, {samples::rectangle(20.0, 0.0, 21.0, 1.0), in_hole[0]}))
        << "a part of B that is not its first";
    EXPECT_FALSE(intersect({outer, hole}, {samples::rectangle(3.5, 3.5, 6.5, 6.5), island}))
        << "a ring with a hole in a hole";
}

TEST(OverlapTest, InterlockedCombsThatDoNotTouch) {
    // The teeth of one in the gaps of the other: boxes of long chains overlap everywhere.
    const std::uint32_t teeth = 200;
    const Polygon comb = samples::polygon({samples::comb(teeth)});
    for (const double turn : {0.0, 0.7}) {
        for (const bool touching : {false, true}) {
            const Vector to =
                Eigen::Rotation2Dd(turn) * Vector((touching ? 0.7 : 0.89) * 2.0 / teeth, 0.5);
            const TransformedPolygon a(comb, {{0.0, 0.0}, turn});
            // Rotated by 180 degrees about the origin, then moved along the row of teeth.
            const TransformedPolygon b(comb, {{to.x(), to.y()}, turn + std::numbers::pi});
            EXPECT_EQ(intersects(a, b), intersect_by_force(a, b)) << turn << ", " << touching;
            EXPECT_EQ(intersects(a, b), touching) << turn;
        }
    }
}

}  // namespace
}  // namespace nearfield::narrowphase
