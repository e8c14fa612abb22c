#include <engine/narrowphase/boundary.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <limits>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

double brute_force_squared_distance(const TransformedPolygon& placed, const Vector& point) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < placed.polygon().size(); ++i) {
        const auto nearest = geometry::nearest_on_segment(point, placed.vertex(i),
                                                          placed.vertex(placed.polygon().next(i)));
        least = std::min(least, nearest.squared_distance);
    }
    return least;
}

template <class Check>
void for_each_placed_shape(const Check& check) {
    samples::Random random(31);
    for (const samples::NamedRings& shape : samples::assorted_shapes(random)) {
        for (const Pose& pose : {Pose{}, Pose{{1e4, -3.0}, 0.7}}) {
            SCOPED_TRACE(shape.name + " moved by " + std::to_string(pose.translation.x));
            const Polygon polygon = samples::polygon(shape.rings);
            const TransformedPolygon placed(polygon, pose);
            check(placed, random);
        }
    }
}

Vector any_point(const TransformedPolygon& placed, samples::Random& random) {
    return placed.to_world({random.between(-2.0, 2.0), random.between(-2.0, 2.0)});
}

TEST(ExactBoundary, NearestIsThatOfBruteForce) {
    for_each_placed_shape([](const TransformedPolygon& placed, samples::Random& random) {
        Boundary boundary;
        boundary.set(placed);
        for (int i = 0; i < 200; ++i) {
            const Vector p = any_point(placed, random);
            const NearestPoint nearest = boundary.nearest(p);
            // Coincident walls are transformed to positions that differ by the rounding at 10,000.
            EXPECT_NEAR(nearest.on_edge.squared_distance, brute_force_squared_distance(placed, p),
                        1e-12);
            const auto on_edge = geometry::nearest_on_segment(
                p, placed.vertex(nearest.edge), placed.vertex(placed.polygon().next(nearest.edge)));
            EXPECT_EQ(on_edge.point, nearest.on_edge.point);
        }
    });
}

TEST(ExactBoundary, ContainsIsThatOfTheWholePolygon) {
    for_each_placed_shape([](const TransformedPolygon& placed, samples::Random& random) {
        Boundary boundary;
        boundary.set(placed);
        for (int i = 0; i < 200; ++i) {
            const Vector p = any_point(placed, random);
            if (brute_force_squared_distance(placed, p) > 1e-18) {
                EXPECT_EQ(boundary.contains(p), contains(placed, p)) << p.transpose();
            }
        }
    });
}

TEST(ExactBoundary, NormalsLeadOut) {
    std::size_t checked = 0;
    for_each_placed_shape([&](const TransformedPolygon& placed, samples::Random& random) {
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
    });
    EXPECT_GT(checked, 1000U);
}

/// A place within rounding of an edge's end has the edge's normal, not its opposite.
TEST(ExactBoundary, NormalsLeadOutAtTheEndsOfEdges) {
    const Polygon polygon = samples::polygon({samples::rectangle(0.0, 0.0, 1.0, 1.0)});
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
    const Polygon polygon = samples::polygon({samples::rectangle(0.0, 0.0, 2.0, 10.0)});
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
