#include <engine/geometry/fill_mesh.hpp>
#include <engine/geometry/offset_mesh.hpp>
#include <engine/queries/overlap_boundary.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace nearfield::queries {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

constexpr geometry::SubpixelGrid grid;
constexpr double offset = 0.9;  // in cells
constexpr double slack = 0.1;

/// One tile's view of a shape: the samples inside, and the offset polygons.
struct Seen {
    std::vector<bool> inside;
    /// For each offset polygon the first edge and the number of edges of its run, and its corners.
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::vector<std::pair<double, double>>>>
        polygons;

    [[nodiscard]] bool operator==(const Seen&) const = default;
};

void invert_left_of(const geometry::FillMesh::Piece& piece, const Tile& tile,
                    std::vector<bool>& inside) {
    const auto [x0, y0, x1, y1] = piece;
    for (std::uint32_t row = 0; row < tile.height; ++row) {
        const double y = row + 0.5;
        if (y < std::min(y0, y1) || y >= std::max(y0, y1)) {
            continue;
        }
        const double x = x0 + (y - y0) / (y1 - y0) * (x1 - x0);
        for (std::uint32_t column = 0; column < tile.width && column + 0.5 < x; ++column) {
            inside[row * tile.width + column] = !inside[row * tile.width + column];
        }
    }
}

Seen seen(const TileBoundary& boundary, const Tile& tile) {
    Seen seen;
    std::vector<TileEdge> crossing;
    crossing_edges(boundary, tile.width, tile.height, slack, crossing);
    seen.inside.assign(std::size_t{tile.width} * tile.height, false);
    const geometry::FillMesh mesh(tile.width, tile.height, grid);
    for (const TileEdge& edge : crossing) {
        for (const geometry::FillMesh::Piece& piece : mesh.pieces(edge.a, edge.b)) {
            invert_left_of(piece, tile, seen.inside);
        }
    }
    boundary.for_offset_edges(tile.width, tile.height, offset, [&](std::uint32_t i) {
        const auto polygon = geometry::offset_polygon(boundary.start(i), boundary.end(i), offset,
                                                      tile.width, tile.height, grid);
        if (polygon) {
            auto& [first, count, corners] = seen.polygons.emplace_back();
            first = boundary.edge(i).first;
            count = boundary.edge(i).count;
            for (const Vector& corner : *polygon) {
                corners.emplace_back(corner.x(), corner.y());
            }
        }
    });
    return seen;
}

TEST(OverlapBoundary, ShowsATileWhatTheWholeBoundaryDoes) {
    std::size_t edges_left_out = 0;
    bool anything_inside = false;
    bool any_polygon = false;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        test::Random random(seed);
        const test::NamedRings shape =
            random.whole(0, 2) == 0 ? test::any_shape(random)
                                    : test::NamedRings{"coast", test::coast(random, 4000, 0.3)};
        SCOPED_TRACE(shape.name + ", seed " + std::to_string(seed));
        Polygon polygon;
        ASSERT_TRUE(polygon.assign(shape.rings).ok());
        Tile tile;
        tile.grid.cell = random.scale(0.001, 0.02);
        tile.grid.origin = Vector(random.between(-1.2, 1.0), random.between(-1.2, 1.0));
        tile.width = static_cast<std::uint32_t>(random.whole(1, 90));
        tile.height = static_cast<std::uint32_t>(random.whole(1, 90));
        ErrorBudget budget;
        budget.simplification = slack * tile.grid.cell;
        budget.offset = offset * tile.grid.cell;
        const Pose pose{{0.1, -0.05}, random.between(0.0, 6.0)};

        SimplifiedShapes shapes;
        const TileBoundary part = overlap_boundary(polygon, pose, budget, tile, shapes);
        const std::uint32_t edges_of_part = part.size();
        const Seen by_part = seen(part, tile);
        const TransformedPolygon placed(polygon, pose);
        const TileBoundary whole(
            shapes.get_near(placed, {Vector(-1e9, -1e9), Vector(1e9, 1e9)}, budget.simplification,
                            longest_tile_run * tile.grid.cell),
            ToCells(placed, tile.origin(), tile.grid.cell));
        ASSERT_TRUE(by_part == seen(whole, tile));
        edges_left_out += whole.size() - edges_of_part;
        anything_inside =
            anything_inside || std::count(by_part.inside.begin(), by_part.inside.end(), true) > 0;
        any_polygon = any_polygon || !by_part.polygons.empty();
    }
    EXPECT_GT(edges_left_out, 1000U);
    EXPECT_TRUE(anything_inside && any_polygon);
}

TEST(OverlapBoundary, SimplifiesAllOfAShapeThatManyTilesLookAt) {
    test::Random random(3);
    Polygon polygon;
    ASSERT_TRUE(polygon.assign(test::coast(random, 4000, 0.3)).ok());
    ErrorBudget budget;
    budget.simplification = 1e-4;
    budget.offset = 1e-3;
    SimplifiedShapes shapes;
    std::uint32_t edges = 0;
    std::uint32_t looks = 0;
    for (; edges < 2000U && looks < 200U; ++looks) {
        Tile tile;
        tile.grid.cell = 1e-3;
        tile.grid.origin = Vector(-1.0 + 0.01 * looks, 0.0);
        tile.width = tile.height = 10;
        edges = overlap_boundary(polygon, {}, budget, tile, shapes).size();
    }
    EXPECT_GT(looks, 1U);
    EXPECT_LT(looks, 200U) << "by then parts have taken more than all would";
}

}  // namespace
}  // namespace nearfield::queries
