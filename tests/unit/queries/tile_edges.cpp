#include <engine/geometry/segment.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/queries/simplified_shapes.hpp>
#include <engine/queries/tile_edges.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>
#include <tests/unit/support/tile_cases.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::queries {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

using test::cases;
using test::height;
using test::width;

bool crosses(const Vector& p, const Vector& a, const Vector& b) {
    return (a.y() > p.y()) != (b.y() > p.y()) &&
           p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

/// The distance from a point to an edge, computed from the edge only.
double distance_to(const TileBoundary& boundary, const Vector& p, std::uint32_t edge) {
    return std::sqrt(
        geometry::nearest_on_segment(p, boundary.start(edge), boundary.end(edge)).squared_distance);
}

TEST(TileBoundary, FindsWhatAPlainScanFinds) {
    test::Random random(3);
    for (const auto& c : cases(0.3)) {
        for (int i = 0; i < 20; ++i) {
            const double far = random.scale(1.0, 1e4);
            const Vector p(random.between(-far, far), random.between(-far, far));
            const double reach = random.scale(1.0, 1e4);
            double nearest = 1e300;
            std::vector<std::uint32_t> wanted;
            for (std::uint32_t e = 0; e < c->boundary().size(); ++e) {
                const double distance = distance_to(c->boundary(), p, e);
                nearest = std::min(nearest, distance);
                if (distance <= reach) {
                    wanted.push_back(e);
                }
            }
            ASSERT_EQ(c->boundary().distance(p), nearest) << c->name << " at " << p.transpose();
            std::vector<std::uint32_t> found;
            std::uint32_t visited = 0;
            c->boundary().for_edges_near(p, reach, [&](std::uint32_t e) {
                ++visited;
                if (distance_to(c->boundary(), p, e) <= reach) {
                    found.push_back(e);
                }
            });
            ASSERT_EQ(found, wanted) << c->name << " at " << p.transpose();
            ASSERT_LE(visited, c->boundary().size()) << c->name;
        }
    }
}

TEST(TileBoundary, LooksOnlyAtWhatIsNear) {
    test::Random random(4);
    Polygon polygon;
    ASSERT_TRUE(polygon.assign(test::scaled_and_moved(test::regular(20000), 1e5, {})).ok());
    SimplifiedShapes shapes;
    const TileBoundary boundary(shapes.get(polygon, 1e-9, 64.0),
                                ToCells(TransformedPolygon(polygon, {}), Vector::Zero(), 1.0));
    ASSERT_EQ(boundary.size(), 20000U);
    std::uint32_t visited = 0;
    boundary.for_edges_near({1e5, 0.0}, 100.0, [&](std::uint32_t) { ++visited; });
    EXPECT_GE(visited, 6U);  // an edge is 31 cells long
    EXPECT_LE(visited, 40U);
    std::vector<TileEdge> crossing;
    crossing_edges(boundary, width, height, 0.3, crossing);
    EXPECT_LE(crossing.size(), 2U) << "the right half of the circle";
}

TEST(CrossingEdges, GiveTheParityOfTheWholeBoundary) {
    test::Random random(5);
    for (const auto& c : cases(0.3)) {
        std::vector<TileEdge> crossing;
        crossing_edges(c->boundary(), width, height, 0.3, crossing);
        for (int i = 0; i < 100; ++i) {
            const Vector p(random.between(0.0, width), random.between(0.0, height));
            bool whole = false;
            double distance = 1e300;
            for (std::uint32_t e = 0; e < c->boundary().size(); ++e) {
                const Vector a = c->boundary().start(e);
                const Vector b = c->boundary().end(e);
                whole = whole != crosses(p, a, b);
                distance =
                    std::min(distance, geometry::nearest_on_segment(p, a, b).squared_distance);
            }
            bool odd = false;
            for (const TileEdge& edge : crossing) {
                odd = odd != crosses(p, edge.a, edge.b);
                EXPECT_LE(edge.simplified == no_simplified ? edge.a.x() : 0.0, width + 2.0);
            }
            if (distance > 1e-12) {
                ASSERT_EQ(odd, whole) << c->name << " at " << p.transpose();
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::queries
