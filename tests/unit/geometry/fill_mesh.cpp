#include <engine/geometry/fill_mesh.hpp>

#include <gtest/gtest.h>
#include <tests/support/degenerate_polygons.hpp>
#include <tests/support/scanline.hpp>

#include <cmath>
#include <cstddef>

namespace nearfield {
namespace {

using geometry::FillMesh;
using geometry::Mesh;
using geometry::SubpixelGrid;
using geometry::Vector;
using support::Tile;

constexpr Tile fill_tiles[] = {{.width = 64, .height = 64},
                               {.width = 1, .height = 1},
                               {.width = 7, .height = 50},
                               {.width = 97, .height = 3},
                               {.width = 32, .height = 32, .grid = {.steps = 16.0}}};

template <typename Visit>
void for_each_edge(const support::Rings& rings, const Visit& visit) {
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            visit(ring[i], ring[(i + 1) % ring.size()]);
        }
    }
}

Mesh fill(const Tile& tile, const support::Rings& rings) {
    const FillMesh fill_mesh(tile.width, tile.height, tile.grid);
    Mesh mesh;
    for_each_edge(rings, [&](const Vector& a, const Vector& b) { fill_mesh.append(a, b, mesh); });
    return mesh;
}

bool is_far_from_tile(const Vector& p, const Tile& tile) {
    return p.x() < -1.0 || p.y() < -1.0 || p.x() > tile.width + 1.0 || p.y() > tile.height + 1.0;
}

// Edges near the tile are not cut, so a wrong sample there is an error. A cut edge may have moved
// by the maximum displacement, as the snapped edge in the scanline has.
bool is_beside_a_cut_edge(const Vector& centre, const Tile& tile, const support::Rings& rings) {
    bool beside = false;
    for_each_edge(rings, [&](const Vector& a, const Vector& b) {
        const bool is_cut = is_far_from_tile(a, tile) || is_far_from_tile(b, tile);
        beside = beside || (is_cut && support::distance_to_segment(centre, a, b) <=
                                          tile.grid.largest_move() + 1e-9);
    });
    return beside;
}

void expect_scanline_parity(const Tile& tile, const support::DegeneratePolygon& polygon) {
    const Mesh mesh = fill(tile, polygon.rings);
    const auto drawn = support::draw_parity(tile, mesh);
    const auto scanned = support::scan_parity(tile, polygon.rings);
    for (std::uint32_t row = 0; row < tile.height; ++row) {
        for (std::uint32_t column = 0; column < tile.width; ++column) {
            const std::size_t i = tile.index(column, row);
            if (drawn[i] != scanned[i] &&
                !is_beside_a_cut_edge(Tile::centre(column, row), tile, polygon.rings)) {
                ADD_FAILURE() << polygon.name << " at column " << column << ", row " << row;
                return;
            }
        }
    }
}

void expect_near_and_snapped(const Tile& tile, const support::DegeneratePolygon& polygon) {
    for (const auto& vertex : fill(tile, polygon.rings)) {
        const Vector position(static_cast<double>(vertex.x), static_cast<double>(vertex.y));
        ASSERT_FALSE(is_far_from_tile(position, tile)) << polygon.name;
        ASSERT_EQ(position.x(), tile.grid.snap(position.x())) << polygon.name;
        ASSERT_EQ(position.y(), tile.grid.snap(position.y())) << polygon.name;
    }
}

TEST(SubpixelGrid, SnapsToTheNearestStepAndHalvesUp) {
    const SubpixelGrid grid{.steps = 16.0};
    EXPECT_EQ(grid.snap(0.5), 0.5);
    EXPECT_EQ(grid.snap(1.0 / 32.0), 1.0 / 16.0);
    EXPECT_EQ(grid.snap(-1.0 / 32.0), 0.0);
    EXPECT_EQ(grid.snap(-1.0 / 31.0), -1.0 / 16.0);
    EXPECT_NEAR(grid.largest_move(), std::hypot(1.0 / 32.0, 1.0 / 32.0), 1e-15);
}

TEST(FillMesh, ParityIsTheScanlineOfTheSnappedPolygon) {
    for (const Tile& tile : fill_tiles) {
        for (std::uint32_t seed = 1; seed <= 30; ++seed) {
            for (const auto& polygon :
                 support::degenerate_polygons(tile.width, tile.height, seed)) {
                expect_scanline_parity(tile, polygon);
            }
        }
    }
}

TEST(FillMesh, FarVerticesDisturbOnlySamplesOnTheirEdges) {
    for (const Tile& tile : fill_tiles) {
        for (std::uint32_t seed = 1; seed <= 200; ++seed) {
            for (const auto& polygon : support::huge_polygons(tile.width, tile.height, seed)) {
                expect_scanline_parity(tile, polygon);
            }
        }
    }
}

TEST(FillMesh, StaysNearTheTileAndOnTheGrid) {
    for (const Tile& tile : fill_tiles) {
        for (std::uint32_t seed = 1; seed <= 20; ++seed) {
            for (const auto& polygon :
                 support::degenerate_polygons(tile.width, tile.height, seed)) {
                expect_near_and_snapped(tile, polygon);
            }
            for (const auto& polygon : support::huge_polygons(tile.width, tile.height, seed)) {
                expect_near_and_snapped(tile, polygon);
            }
        }
    }
}

}  // namespace
}  // namespace nearfield
