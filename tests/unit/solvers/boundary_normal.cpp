#include <engine/solvers/boundary_normal.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

namespace nearfield::solvers {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

/// A square with a hole that far from the origin is smaller than the rounding of its vertices.
TEST(BoundaryNormal, OfARingThatIsOnePointInTheWorldIsAUnitVector) {
    const Polygon polygon =
        samples::polygon({test::rectangle({-3e-4, -3e-4}, {3e-4, 3e-4}).front(),
                          test::rectangle({1e-4, 1e-4}, {1e-4 + 1e-12, 1e-4 + 2e-12}).front()});
    const TransformedPolygon placed(polygon, {{-974890.0, -974896.0}, 0.0});
    for (std::uint32_t i = 5; i < 8; ++i) {
        ASSERT_EQ(placed.vertex(4), placed.vertex(i));
    }
    narrowphase::Boundary boundary;
    boundary.set(placed);
    for (std::uint32_t edge = 4; edge < polygon.size(); ++edge) {
        const AskedBoundaryNormal asked = ask_outward_normal(boundary, edge, 0.5);
        boundary.answer_asked();
        const Vector normal = outward_normal(boundary, asked);
        EXPECT_NEAR(normal.norm(), 1.0, 1e-12) << "edge " << edge;
    }
}

}  // namespace
}  // namespace nearfield::solvers
