#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/deepest_point.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/point_samples.hpp>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::Vector;
using samples::Points;

/// The squared distances of a point from its nearest edge and the next one.
std::pair<double, double> two_least(const simd::TransformedEdges& edges, const Vector& point) {
    std::vector<double> squared;
    for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
        squared.push_back(geometry::nearest_on_segment(point, edges.start(edge), edges.end(edge))
                              .squared_distance);
    }
    std::sort(squared.begin(), squared.end());
    return {squared[0], squared[1]};
}

/// Whoever sees a bound above the margin takes the way out for the only one.
TEST(DeepestPoint, HasNoBoundAboveAnEdgeWithinTheMargin) {
    samples::Random random(601);
    DeepestPointFinder finder;
    constexpr double margin = 0.02;
    std::uint32_t told = 0;
    std::uint32_t rivals = 0;
    for (const samples::NamedRings& shape : samples::assorted_shapes(random)) {
        SCOPED_TRACE(shape.name);
        const Polygon polygon = samples::polygon(shape.rings);
        simd::TransformedInstances instances;
        const std::uint32_t index = instances.place(polygon, {});
        instances.complete(index);
        const simd::TransformedEdges& edges = instances[index];
        for (int i = 0; i < 200; ++i) {
            Points points;
            const std::uint32_t count = 1 + random.below(i % 5 == 0 ? 300 : 8);
            for (std::uint32_t k = 0; k < count; ++k) {
                points.push({random.between(-1.2, 1.2), random.between(-1.2, 1.2)});
            }
            const DeepestPoint found = finder.find(points.arrays(), edges, 1e-9, margin);
            const Vector point(points.x[found.point], points.y[found.point]);
            const auto [nearest, second] = two_least(edges, point);
            const double limit = std::sqrt(nearest) + margin;
            if (second <= limit * limit) {
                EXPECT_LE(found.nearest.second_squared, second + 1e-11);
                ++rivals;
            }
            // Missing is 0.
            told += found.nearest.second_squared > 0.0 ? 1U : 0U;
        }
    }
    EXPECT_GT(told, 500U);
    EXPECT_GT(rivals, 500U);
}

}  // namespace
}  // namespace nearfield::narrowphase
