#include <engine/raster/closest_chains.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <vector>

namespace nearfield::raster {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;

TEST(ClosestChains, LookOnlyWhereTheClosestCanBe) {
    test::Random random(6);
    const Polygon polygon_a = samples::polygon(test::coast(random, 4096, 0.5));
    const Polygon polygon_b = samples::polygon(test::coast(random, 4096, 0.5));
    const TransformedPolygon a(polygon_a, {});
    const TransformedPolygon b(polygon_b, {{5.0, 0.0}, 1.0});
    ClosestChains closest;
    std::vector<geometry::Chain> chains;
    const geometry::Effort effort =
        closest.find(a, b, {12, 0.0, BoundingVolume::axis_aligned}, chains);
    EXPECT_LT(effort.nodes_evaluated, 1500U) << "of 16382 that there are";
    EXPECT_GT(effort.pairs_rejected, 0U);
}

}  // namespace
}  // namespace nearfield::raster
