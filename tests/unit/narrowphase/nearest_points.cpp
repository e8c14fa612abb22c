#include <engine/narrowphase/nearest_points.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/awkward_shapes.hpp>
#include <tests/unit/support/placed_shapes.hpp>
#include <tests/unit/support/point_samples.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;
using samples::Points;

/// Scattered points, or points along lines at various spacings.
Points any_points(const TransformedPolygon& placed, test::Random& random) {
    Points points;
    const std::uint32_t count = 1 + random.below(40);
    const bool along_a_line = random.below(3) > 0;
    const double step = std::pow(10.0, random.between(-4.0, 0.0));
    Vector at(random.between(-1.5, 1.5), random.between(-1.5, 1.5));
    const double angle = random.between(-4.0, 4.0);
    for (std::uint32_t i = 0; i < count; ++i) {
        points.push(placed.to_world(at));
        at = along_a_line ? Vector(at + step * Vector(std::cos(angle), std::sin(angle)))
                          : Vector(random.between(-1.5, 1.5), random.between(-1.5, 1.5));
    }
    return points;
}

/// Calls `check(edges, points)` for points around all kinds of shapes, small and large.
template <class Check>
void for_each_list(const Check& check) {
    test::Random random(95);
    samples::for_each_placed(samples::assorted_shapes(random), {{1e4, -3.0}, 0.7},
                             [&](const simd::TransformedEdges& edges) {
                                 for (int i = 0; i < 200; ++i) {
                                     check(edges, any_points(edges.placed, random));
                                 }
                             });
}

/// The squared distances of all edges from a point.
std::vector<double> squared_distances(const simd::TransformedEdges& edges, const Vector& point) {
    std::vector<double> squared;
    for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
        squared.push_back(geometry::nearest_on_segment(point, edges.start(edge), edges.end(edge))
                              .squared_distance);
    }
    return squared;
}

TEST(NearestPoints, AreThoseOfBruteForce) {
    NearestPoints nearest;
    std::uint32_t large = 0;
    for_each_list([&](const simd::TransformedEdges& edges, const Points& points) {
        large += simd::is_small(edges) ? 0U : 1U;
        nearest.find(points.arrays(), edges, 1e-3);
        const simd::NearestArrays& found = nearest.arrays();
        for (std::uint32_t i = 0; i < points.count; ++i) {
            const Vector point(points.x[i], points.y[i]);
            const std::vector<double> squared = squared_distances(edges, point);
            const double least = *std::min_element(squared.begin(), squared.end());
            ASSERT_LT(found.edge[i], edges.count);
            EXPECT_NEAR(found.distance[i], std::sqrt(least), 1e-7 * edges.rounding + 1e-11);
            const geometry::NearestOnSegment on_edge = geometry::nearest_on_segment(
                point, edges.start(found.edge[i]), edges.end(found.edge[i]));
            EXPECT_EQ(found.x[i], on_edge.point.x());
            EXPECT_EQ(found.y[i], on_edge.point.y());
            EXPECT_EQ(found.parameter[i], on_edge.parameter);
            EXPECT_EQ(found.distance[i], std::sqrt(on_edge.squared_distance));
        }
    });
    EXPECT_GT(large, 300U);
}

/// Samples of two nearby edges out of many in turns, so that consecutive ones are far apart, and
/// any other points.
Points many_points(const simd::TransformedEdges& edges, test::Random& random) {
    Points points;
    for (int i = 0; i < 700; ++i) {
        const std::uint32_t edge = random.below(edges.count);
        const Vector along = edges.end(edge) - edges.start(edge);
        const double aside = random.below(3) == 0 ? 0.0 : random.between(-0.1, 0.1);
        points.push(edges.at(edge, random.below(4) == 0 ? 0.0 : random.between(0.0, 1.0)) +
                    aside * Vector(-along.y(), along.x()));
    }
    // Several in almost the same place.
    const Vector place(points.x[0], points.y[0]);
    for (int i = 0; i < 40; ++i) {
        points.push(place + 1e-6 * Vector(random.between(-1.0, 1.0), random.between(-1.0, 1.0)));
    }
    return points;
}

/// The nearest edge, and every other one within the margin, bit for bit: of equally near ones the
/// first.
TEST(NearestPoints, OfPointsAmongCrowdedEdgesAreThoseOfBruteForce) {
    constexpr double margin = 1e-3;
    NearestPoints nearest;
    test::Random random(96);
    const auto check = [&](const simd::TransformedEdges& edges) {
        const Points points = many_points(edges, random);
        nearest.find(points.arrays(), edges, margin);
        const simd::NearestArrays& found = nearest.arrays();
        for (std::uint32_t i = 0; i < points.count; ++i) {
            const Vector point(points.x[i], points.y[i]);
            std::vector<double> squared = squared_distances(edges, point);
            std::partial_sort(squared.begin(), squared.begin() + 3, squared.end());
            const double allowed = 16.0 * edges.rounding;
            EXPECT_NEAR(found.distance[i], std::sqrt(squared[0]), allowed) << i;
            const double limit = std::sqrt(squared[0]) + margin;
            for (const auto& [other, truth] : {std::pair(found.second_squared[i], squared[1]),
                                               std::pair(found.third_squared[i], squared[2])}) {
                EXPECT_GE(std::sqrt(other), std::sqrt(truth) - allowed) << i;
                if (std::sqrt(truth) <= limit) {
                    EXPECT_NEAR(std::sqrt(other), std::sqrt(truth), allowed) << i;
                }
            }
        }
    };
    samples::for_each_placed(samples::awkward_shapes(random), {{1e6, -3e5}, 0.3}, check);
}

TEST(NearestPoints, AreUniqueWhereTheBoundarySaysSo) {
    NearestPoints nearest;
    std::uint32_t unique = 0;
    std::uint32_t not_unique = 0;
    for_each_list([&](const simd::TransformedEdges& edges, const Points& points) {
        for (const double margin : {1e-6, 1e-2}) {
            nearest.find(points.arrays(), edges, margin);
            Boundary boundary;
            boundary.set(edges);
            for (std::uint32_t i = 0; i < points.count; ++i) {
                const Vector point(points.x[i], points.y[i]);
                const std::uint32_t edge = nearest.arrays().edge[i];
                const NearestPoint found{
                    edge, geometry::nearest_on_segment(point, edges.start(edge), edges.end(edge))};
                const bool expected = boundary.is_unique(point, found, margin);
                EXPECT_EQ(nearest.is_unique(i), expected) << point.transpose();
                ++(expected ? unique : not_unique);
            }
        }
    });
    EXPECT_GT(unique, 10000U);
    EXPECT_GT(not_unique, 1000U);
}

}  // namespace
}  // namespace nearfield::narrowphase
