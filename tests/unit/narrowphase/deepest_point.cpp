#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/deepest_point.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/awkward_shapes.hpp>
#include <tests/unit/support/point_samples.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::Vector;
using samples::Points;

/// A path with straight and bent sections, with occasional jumps.
Points walk(const simd::TransformedEdges& edges, samples::Random& random) {
    Points points;
    const std::uint32_t count = 1 + random.below(600);
    const double step = std::pow(10.0, random.between(-4.0, -1.0));
    Vector at(random.between(-1.2, 1.2), random.between(-1.2, 1.2));
    double angle = random.between(-4.0, 4.0);
    double bend = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        points.push(edges.placed.to_world(at));
        at += step * random.between(0.0, 1.0) * Vector(std::cos(angle), std::sin(angle));
        angle += bend;
        if (random.below(40) == 0) {
            bend = random.between(-0.2, 0.2);
        }
        if (random.below(150) == 0) {
            at = {random.between(-1.2, 1.2), random.between(-1.2, 1.2)};
        }
    }
    return points;
}

/// The depth of every point.
std::vector<double> depths(const simd::TransformedEdges& edges, const Points& points) {
    std::vector<double> depths;
    for (std::uint32_t i = 0; i < points.count; ++i) {
        const Vector point(points.x[i], points.y[i]);
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
            least = std::min(least,
                             geometry::nearest_on_segment(point, edges.start(edge), edges.end(edge))
                                 .squared_distance);
        }
        depths.push_back(std::sqrt(least));
    }
    return depths;
}

TEST(DeepestPoint, IsThatOfBruteForce) {
    samples::Random random(77);
    DeepestPointFinder finder;
    std::uint32_t many = 0;
    std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    for (samples::NamedRings& shape : samples::awkward_shapes(random)) {
        shapes.push_back(std::move(shape));
    }
    for (const samples::NamedRings& shape : shapes) {
        for (const Pose& pose : {Pose{}, Pose{{1e4, -3.0}, 0.7}, Pose{{1e6, 1e6}, -2.0}}) {
            SCOPED_TRACE(shape.name + " moved by " + std::to_string(pose.translation.x));
            const Polygon polygon = samples::polygon(shape.rings);
            simd::TransformedInstances instances;
            const std::uint32_t index = instances.place(polygon, pose);
            instances.complete(index);
            const simd::TransformedEdges& edges = instances[index];
            const double rounding = 1e-11 + edges.rounding;
            const int lists = edges.count > 1000 ? 2 : 20;
            for (int i = 0; i < lists; ++i) {
                const Points points = walk(edges, random);
                many += points.count >= 128 ? 1U : 0U;
                const std::vector<double> truth = depths(edges, points);
                const double most = *std::max_element(truth.begin(), truth.end());
                for (const double touching : {edges.rounding, 0.01, 0.5}) {
                    const DeepestPoint found = finder.find(points.arrays(), edges, touching, 1e-3);
                    const auto deeper_than = [&](double limit) {
                        return std::count_if(truth.begin(), truth.end(),
                                             [limit](double depth) { return depth > limit; });
                    };
                    EXPECT_GE(found.count, deeper_than(touching + rounding));
                    EXPECT_LE(found.count, deeper_than(touching - rounding));
                    ASSERT_LT(found.point, points.count);
                    EXPECT_NEAR(truth[found.point], most, rounding);
                    if (found.count > 0) {
                        const Vector point(points.x[found.point], points.y[found.point]);
                        const std::uint32_t edge = found.nearest.edge;
                        ASSERT_LT(edge, edges.count);
                        EXPECT_NEAR(std::sqrt(geometry::nearest_on_segment(point, edges.start(edge),
                                                                           edges.end(edge))
                                                  .squared_distance),
                                    most, rounding);
                    }
                }
            }
        }
    }
    EXPECT_GT(many, 500U);
}

/// Of equally deep points the first one is reported, whichever is tested first.
TEST(DeepestPoint, IsTheFirstOfEquallyDeepOnes) {
    const Polygon square = samples::polygon({{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}});
    simd::TransformedInstances instances;
    const std::uint32_t index = instances.place(square, Pose{});
    Points points;
    // Half a unit below the upper side, from left to right, back and forth.
    for (int i = 0; i < 400; ++i) {
        const int k = i % 100;
        points.push({-0.4 + 0.008 * (i / 100 % 2 == 0 ? k : 99 - k), i < 37 ? 0.6 : 0.5});
    }
    DeepestPointFinder finder;
    const DeepestPoint found = finder.find(points.arrays(), instances[index], 1e-9, 1e-3);
    EXPECT_EQ(found.count, 400U);
    EXPECT_EQ(found.point, 37U);
    EXPECT_EQ(found.nearest.edge, 2U);
}

}  // namespace
}  // namespace nearfield::narrowphase
