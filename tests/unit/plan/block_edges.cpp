#include <engine/geometry/segment.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/block_edges.hpp>
#include <engine/plan/simplified_shapes.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nearfield::plan {
namespace {

using geometry::Vector;

double distance(const Vector& point, const TileEdge& edge) {
    return std::sqrt(geometry::nearest_on_segment(point, edge.a, edge.b).squared_distance);
}

TileEdge as_edge(const SegmentData& segment) {
    const Vector middle(static_cast<double>(segment.middle.x),
                        static_cast<double>(segment.middle.y));
    const Vector half(static_cast<double>(segment.half_way.x),
                      static_cast<double>(segment.half_way.y));
    return {middle - half, middle + half, 0};
}

TEST(BlockEdges, ListTheNearestEdgeOfEveryPlace) {
    constexpr std::uint32_t width = 77;
    constexpr std::uint32_t height = 41;
    std::size_t listed = 0;
    std::size_t all = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        test::Random random(seed);
        for (const test::NamedRings& shape : test::every_family(seed)) {
            SCOPED_TRACE(shape.name + ", seed " + std::to_string(seed));
            const double size = random.scale(3.0, 3e4);
            geometry::Polygon polygon;
            ASSERT_TRUE(polygon.assign(test::scaled_and_moved(shape.rings, size, {})).ok());
            const Pose pose{{random.between(-0.9, 0.9) * size + 0.5 * width,
                             random.between(-0.9, 0.9) * size + 0.5 * height},
                            random.between(0.0, 7.0)};
            SimplifiedShapes shapes;
            const TileBoundary boundary(
                shapes.get(polygon, 0.2, 64.0),
                ToCells(geometry::TransformedPolygon(polygon, pose), Vector::Zero(), 1.0));
            BlockEdges blocks;
            blocks.find(boundary, width, height, 0.0);
            std::vector<TileEdge> edges;
            std::vector<SegmentData> segments;
            for (std::uint32_t block = 0;
                 block < BlockEdges::along(width) * BlockEdges::along(height); ++block) {
                edges.clear();
                blocks.append(block, edges);
                ASSERT_FALSE(edges.empty());
                segments.clear();
                blocks.append(block, segments);
                ASSERT_EQ(segments.size(), edges.size());
                listed += edges.size();
                all += boundary.size();
                const double left = block % BlockEdges::along(width) * block_side;
                const double low = block / BlockEdges::along(width) * block_side;
                for (int i = 0; i < 40; ++i) {
                    const Vector p(std::min<double>(left + random.between(0.0, block_side), width),
                                   std::min<double>(low + random.between(0.0, block_side), height));
                    double nearest = distance(p, edges.front());
                    for (const TileEdge& edge : edges) {
                        nearest = std::min(nearest, distance(p, edge));
                    }
                    ASSERT_LE(nearest, boundary.distance(p) + 1e-9) << p.transpose();
                    double of_segments = std::numeric_limits<double>::infinity();
                    for (const SegmentData& segment : segments) {
                        of_segments = std::min(of_segments,
                                               distance(p - Vector(left, low), as_edge(segment)));
                    }
                    ASSERT_NEAR(of_segments, nearest, 1e-6 * (blocks.window() + nearest));
                }
            }
        }
    }
    EXPECT_LT(listed, all / 2) << "of " << all << " nothing is left out";
}

}  // namespace
}  // namespace nearfield::plan
