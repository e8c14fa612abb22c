#include <engine/narrowphase/boundary.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/placed_shapes.hpp>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

TEST(ExactBoundary, NormalsLeadOut) {
    std::size_t checked = 0;
    test::Random random(31);
    const auto check = [&](const simd::TransformedEdges& edges) {
        const TransformedPolygon& placed = edges.placed;
        Boundary boundary;
        boundary.set(placed);
        std::vector<double> parameters;
        std::vector<AskedNormal> asked;
        for (std::uint32_t edge = 0; edge < placed.polygon().size(); ++edge) {
            parameters.push_back(random.between(0.1, 0.9));
            asked.push_back(boundary.ask_outward_normal(edge, parameters.back()));
        }
        boundary.answer_asked();
        for (std::uint32_t edge = 0; edge < placed.polygon().size(); ++edge) {
            const Vector a = placed.vertex(edge);
            const Vector b = placed.vertex(placed.polygon().next(edge));
            const double parameter = parameters[edge];
            const Vector normal = boundary.outward_normal(asked[edge]);
            if (a == b) {
                EXPECT_TRUE(normal.isZero());
                continue;
            }
            EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
            EXPECT_NEAR(normal.dot((b - a).normalized()), 0.0, 1e-9);
            const Vector middle = a + parameter * (b - a);
            const Vector ahead = middle + 1e-7 * normal;
            const Vector behind = middle - 1e-7 * normal;
            // Where two edges coincide there is no outside.
            if (contains(placed, ahead) != contains(placed, behind)) {
                EXPECT_FALSE(contains(placed, ahead)) << "edge " << edge;
                ++checked;
            }
        }
    };
    samples::for_each_placed(samples::assorted_shapes(random), {{1e4, -3.0}, 0.7}, check);
    EXPECT_GT(checked, 1000U);
}

/// A place within rounding of an edge's end has the edge's normal, not its opposite.
TEST(ExactBoundary, NormalsLeadOutAtTheEndsOfEdges) {
    const Polygon polygon = samples::polygon(test::rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 300; ++i) {
        const TransformedPolygon placed(polygon, {{0.25 * i, -3.0}, 0.02 * i});
        Boundary boundary;
        boundary.set(placed);
        for (std::uint32_t edge = 0; edge < polygon.size(); ++edge) {
            for (const double parameter : {0.0, 1e-17, 1e-15, 1.0 - 1e-15, 1.0}) {
                const AskedNormal asked = boundary.ask_outward_normal(edge, parameter);
                boundary.answer_asked();
                const Vector normal = boundary.outward_normal(asked);
                const Vector middle =
                    0.5 * (placed.vertex(edge) + placed.vertex(polygon.next(edge)));
                EXPECT_GT(normal.dot(middle - placed.to_world({0.0, 0.0})), 0.4)
                    << "edge " << edge << " at " << parameter << ", pose " << i;
            }
        }
    }
}

TEST(ExactBoundary, UniqueUnlessTwoWallsAreAsNear) {
    const Polygon polygon = samples::polygon(test::rectangle({0.0, 0.0}, {2.0, 10.0}));
    const TransformedPolygon placed(polygon, {});
    Boundary boundary;
    boundary.set(placed);
    const auto unique = [&](double x) {
        const Vector p(x, 5.0);
        return boundary.is_unique(p, boundary.nearest(p), 1e-3);
    };
    EXPECT_FALSE(unique(1.0));
    EXPECT_FALSE(unique(1.0004));
    EXPECT_TRUE(unique(1.0006));
    EXPECT_TRUE(unique(0.1));
}

}  // namespace
}  // namespace nearfield::narrowphase
