#include <engine/queries/boundary_points.hpp>
#include <engine/queries/edge_sampler.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <numeric>
#include <set>
#include <vector>

namespace nearfield::queries {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

/// The whole boundary, one chain per ring.
std::vector<geometry::Chain> all_of(const Polygon& polygon) {
    std::vector<geometry::Chain> chains;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        chains.push_back({ring,
                          polygon.ring_begin(ring),
                          polygon.ring_end(ring) - polygon.ring_begin(ring),
                          {}});
    }
    return chains;
}

/// The distance of each vertex along its ring from the ring's first vertex.
std::vector<double> ways_along(const Polygon& polygon) {
    std::vector<double> ways(polygon.vertices().size(), 0.0);
    for (std::uint32_t i = 1; i < ways.size(); ++i) {
        if (polygon.ring_begin(polygon.ring_of(i)) != i) {
            ways[i] = ways[i - 1] + (polygon.vertices()[i] - polygon.vertices()[i - 1]).norm();
        }
    }
    return ways;
}

double length_of_ring(const Polygon& polygon, std::uint32_t ring) {
    double length = 0.0;
    for (std::uint32_t i = polygon.ring_begin(ring); i < polygon.ring_end(ring); ++i) {
        length += (polygon.vertices()[polygon.next(i)] - polygon.vertices()[i]).norm();
    }
    return length;
}

TEST(SampleChains, NoGapAlongTheBoundaryIsWiderThanTheSpacing) {
    for (const test::NamedRings& shape : test::every_family(7)) {
        Polygon polygon;
        ASSERT_TRUE(polygon.assign(shape.rings).ok()) << shape.name;
        const std::vector<double> ways = ways_along(polygon);
        for (const double spacing : {0.003, 0.05, 0.7, 50.0}) {
            SCOPED_TRACE(shape.name + ", spacing " + std::to_string(spacing));
            const TransformedPolygon placed(polygon, {});
            std::vector<BoundaryPoint> points;
            const auto chains = all_of(polygon);
            sample_chains(placed, chains, spacing, placed.box(), points);
            EXPECT_LE(static_cast<double>(points.size()),
                      max_samples(placed, chains, spacing, placed.box()));

            std::vector<double> last(polygon.ring_count(), -1.0);
            for (const BoundaryPoint& point : points) {
                ASSERT_GE(point.parameter, 0.0);
                ASSERT_LT(point.parameter, 1.0);
                const std::uint32_t ring = polygon.ring_of(point.edge);
                const Vector edge =
                    polygon.vertices()[polygon.next(point.edge)] - polygon.vertices()[point.edge];
                const double way = ways[point.edge] + point.parameter * edge.norm();
                if (last[ring] < 0.0) {
                    EXPECT_EQ(way, 0.0) << "a ring starts with a sample";
                } else {
                    EXPECT_LE(way - last[ring], spacing * (1.0 + 1e-9));
                }
                last[ring] = way;
            }
            for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
                EXPECT_LE(length_of_ring(polygon, ring) - last[ring], spacing * (1.0 + 1e-9));
            }
        }
    }
}

TEST(SampleChains, WhereSamplesAreDoesNotDependOnWhatIsAskedFor) {
    for (const test::NamedRings& shape : test::every_family(7)) {
        Polygon polygon;
        ASSERT_TRUE(polygon.assign(shape.rings).ok()) << shape.name;
        for (const double spacing : {0.003, 0.05, 0.7, 50.0}) {
            SCOPED_TRACE(shape.name + ", spacing " + std::to_string(spacing));
            const TransformedPolygon placed(polygon, {});
            std::vector<BoundaryPoint> all;
            sample_chains(placed, all_of(polygon), spacing, placed.box(), all);
            // Some edges, with gaps of various lengths between them; then the same as one chain
            // each.
            std::vector<std::uint32_t> edges;
            std::vector<geometry::Chain> chains;
            for (std::uint32_t edge = 0; edge < polygon.size(); edge += 1 + (edge * 7) % 5) {
                edges.push_back(edge);
                chains.push_back({polygon.ring_of(edge), edge, 1, {}});
            }
            const std::set<std::uint32_t> asked(edges.begin(), edges.end());
            std::vector<BoundaryPoint> expected;
            for (const BoundaryPoint& point : all) {
                if (asked.contains(point.edge)) {
                    expected.push_back(point);
                }
            }
            const auto expect_same = [&](const std::vector<BoundaryPoint>& points) {
                ASSERT_EQ(points.size(), expected.size());
                for (std::size_t i = 0; i < points.size(); ++i) {
                    EXPECT_EQ(points[i].edge, expected[i].edge);
                    EXPECT_EQ(points[i].parameter, expected[i].parameter);
                }
            };
            std::vector<BoundaryPoint> of_edges;
            EdgeSampler sampler(polygon, spacing);
            for (const std::uint32_t edge : edges) {
                const double parts = sampler.parts_of(edge);
                for (double part = 0.0; part < parts; ++part) {
                    of_edges.push_back({edge, part / parts});
                }
            }
            expect_same(of_edges);
            std::vector<BoundaryPoint> of_chains;
            sample_chains(placed, chains, spacing, placed.box(), of_chains);
            expect_same(of_chains);
            EXPECT_LE(static_cast<double>(all.size()), max_samples(polygon, spacing));
        }
    }
}

TEST(VerticesOfChains, AChainThatWrapsGivesItsVerticesAndTheOneAfterIt) {
    Polygon polygon;
    const std::vector<Ring> rings{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {2, 1}, {2, 2}}};
    ASSERT_TRUE(polygon.assign(rings).ok());
    const TransformedPolygon placed(polygon, {});
    std::vector<BoundaryPoint> points;
    vertices_of_chains(placed, {{0, 3, 2, {}}, {1, 4, 3, {}}}, points);
    std::vector<std::uint32_t> edges;
    for (const BoundaryPoint& point : points) {
        EXPECT_EQ(point.parameter, 0.0);
        edges.push_back(point.edge);
    }
    EXPECT_EQ(edges, (std::vector<std::uint32_t>{3, 0, 1, 4, 5, 6}));
}

}  // namespace
}  // namespace nearfield::queries
