#include <engine/geometry/segment.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/queries/simplified_shapes.hpp>
#include <engine/raster/edge_lists.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

namespace nearfield::raster {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

constexpr double extent = 1e6;  // in cells; nothing is cut

/// A list of edges as the compute shaders read it.
class List {
public:
    List(const std::vector<EdgeListWriter::Entry>& geometry, const shaders::EdgeListData& data)
        : geometry_(&geometry), data_(data) {}

    [[nodiscard]] shaders::EdgeData edge(std::uint32_t i) const {
        const EdgeListWriter::Entry* const at = geometry_->data() + data_.edges + 4U * i;
        return {at[0].x,
                at[0].y,
                at[1].x,
                at[1].y,
                std::bit_cast<std::uint32_t>(at[2].x),
                std::bit_cast<std::uint32_t>(at[2].y),
                at[3].x,
                std::bit_cast<std::uint32_t>(at[3].y)};
    }
    [[nodiscard]] Vector at(std::uint32_t place) const {
        return {(*geometry_)[place].x, (*geometry_)[place].y};
    }
    [[nodiscard]] bool is_in_cluster_of(std::uint32_t i, const Vector& point) const {
        const std::uint32_t box = data_.clusters + 2U * (i / shaders::cluster_size);
        constexpr double rounding = 1e-4;  // of single precision, in cells
        return (point.array() >= at(box).array() - rounding).all() &&
               (point.array() <= at(box + 1).array() + rounding).all();
    }

private:
    const std::vector<EdgeListWriter::Entry>* geometry_;
    shaders::EdgeListData data_;
};

std::vector<queries::TileEdge> all_edges(const queries::TileBoundary& boundary) {
    std::vector<queries::TileEdge> edges;
    for (std::uint32_t i = 0; i < boundary.size(); ++i) {
        edges.push_back({boundary.start(i), boundary.end(i), i});
    }
    return edges;
}

/// Checks the vertices of the exact edges for which one edge of a list stands: they are where the
/// tile has them, no farther from it than stated, and in the box of its cluster.
void expect_run(const List& list, std::uint32_t i, const queries::TileBoundary& boundary) {
    const shaders::EdgeData edge = list.edge(i);
    const geometry::SimplifiedEdge& simplified = boundary.edge(i);
    ASSERT_EQ(edge.first_edge, simplified.first);
    ASSERT_EQ(edge.run_count, simplified.count);
    if (simplified.count == 1) {
        return;
    }
    const auto vertices = boundary.simplified().polygon->vertices();
    for (std::uint32_t k = 0; k <= simplified.count; ++k) {
        const std::uint32_t vertex = k < simplified.count ? simplified.first + k : simplified.last;
        const Vector truth = boundary.to_cells()(vertices[vertex]);
        const Vector written = list.at(edge.run + k);
        ASSERT_LE((written - truth).norm(), 1e-3) << "vertex " << k << " of edge " << i;
        const double distance = std::sqrt(
            geometry::nearest_on_segment(truth, {edge.a.x, edge.a.y}, {edge.b.x, edge.b.y})
                .squared_distance);
        ASSERT_LE(distance, edge.deviation) << "vertex " << k << " of edge " << i;
        ASSERT_TRUE(list.is_in_cluster_of(i, written)) << "vertex " << k << " of edge " << i;
    }
}

TEST(EdgeListWriter, WritesEachRunWhereItsTileHasIt) {
    std::uint32_t runs = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        for (const test::NamedRings& shape : test::every_family(seed)) {
            SCOPED_TRACE(shape.name + ", seed " + std::to_string(seed));
            Polygon polygon;
            ASSERT_TRUE(polygon.assign(test::scaled_and_moved(shape.rings, 100.0, {})).ok());
            queries::SimplifiedShapes shapes;
            const queries::SimplifiedBoundary simplified =
                shapes.get(polygon, 0.7, queries::longest_tile_run);
            // Two tiles of one shape, and lists of both that refer to the same runs.
            EdgeListWriter writer;
            for (const Vector& origin : {Vector(0.0, 0.0), Vector(31.0, -17.0)}) {
                const queries::TileBoundary boundary(
                    simplified,
                    queries::ToCells(TransformedPolygon(polygon, {{3.0, 4.0}, 0.5}), origin, 1.0));
                writer.begin_tile(boundary);
                for (int repeated = 0; repeated < 2; ++repeated) {
                    const shaders::EdgeListData data = writer.write(all_edges(boundary), extent);
                    ASSERT_EQ(data.count, boundary.size());
                    const List list(writer.geometry(), data);
                    for (std::uint32_t i = 0; i < data.count; ++i) {
                        expect_run(list, i, boundary);
                        runs += boundary.edge(i).count > 1 ? 1U : 0U;
                    }
                    if (HasFatalFailure()) {
                        return;
                    }
                }
            }
        }
    }
    EXPECT_GT(runs, 1000U);
}

TEST(EdgeListWriter, WritesARunOnceForEachTile) {
    Polygon polygon;
    ASSERT_TRUE(polygon.assign(test::scaled_and_moved(test::regular(200), 100.0, {})).ok());
    queries::SimplifiedShapes shapes;
    const queries::TileBoundary boundary(
        shapes.get(polygon, 0.7, queries::longest_tile_run),
        queries::ToCells(TransformedPolygon(polygon, {}), Vector::Zero(), 1.0));
    ASSERT_LT(boundary.size(), 100U);
    EdgeListWriter writer;
    writer.begin_tile(boundary);
    const shaders::EdgeListData first = writer.write(all_edges(boundary), extent);
    const shaders::EdgeListData second = writer.write(all_edges(boundary), extent);
    EXPECT_LE(second.edges - first.edges, 5U * boundary.size() + 8U) << "without vertices of runs";
}

}  // namespace
}  // namespace nearfield::raster
