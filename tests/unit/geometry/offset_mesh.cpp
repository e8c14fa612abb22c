#include <engine/geometry/offset_mesh.hpp>

#include <gtest/gtest.h>
#include <tests/support/degenerate_polygons.hpp>
#include <tests/support/scanline.hpp>

namespace nearfield {
namespace {

using geometry::Mesh;
using geometry::Vector;
using support::Tile;

constexpr Tile offset_tiles[] = {{.width = 64, .height = 48},
                                 {.width = 5, .height = 64, .grid = {.steps = 16.0}}};

double bound(double offset, const Tile& tile) {
    return offset * geometry::offset_overreach + 3.0 * tile.grid.largest_move();
}

// Checks both properties at every sample of the tile, and at every vertex, which bound the rest.
void expect_laws(const Tile& tile, const Vector& a, const Vector& b, double offset) {
    Mesh mesh;
    geometry::append_offset_polygon(a, b, offset, tile.width, tile.height, tile.grid, 7, mesh);
    ASSERT_TRUE(mesh.empty() || mesh.size() == 18U);
    const auto drawn = support::draw_nearest(tile, mesh);
    const std::string what = testing::PrintToString(a.transpose()) + " to " +
                             testing::PrintToString(b.transpose()) + " offset " +
                             std::to_string(offset);
    for (std::uint32_t row = 0; row < tile.height; ++row) {
        for (std::uint32_t column = 0; column < tile.width; ++column) {
            const double distance = support::distance_to_segment(Tile::centre(column, row), a, b);
            const bool covered = drawn[tile.index(column, row)].id == 7U;
            ASSERT_TRUE(covered || distance > offset) << what;
            ASSERT_TRUE(!covered || distance <= bound(offset, tile)) << what;
        }
    }
    for (const auto& vertex : mesh) {
        const Vector position(static_cast<double>(vertex.x), static_cast<double>(vertex.y));
        ASSERT_LE(support::distance_to_segment(position, a, b), bound(offset, tile)) << what;
        const double margin = 2.0 * bound(offset, tile);
        ASSERT_GE(position.minCoeff(), -margin) << what;
        ASSERT_LE(position.x(), tile.width + margin) << what;
        ASSERT_LE(position.y(), tile.height + margin) << what;
        ASSERT_EQ(vertex.id, 7U);
        ASSERT_EQ(position.x(), tile.grid.snap(position.x())) << what;
        ASSERT_EQ(position.y(), tile.grid.snap(position.y())) << what;
    }
}

TEST(OffsetMesh, CoversTheOffsetAndLittleMore) {
    for (const Tile& tile : offset_tiles) {
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            auto polygons = support::degenerate_polygons(tile.width, tile.height, seed);
            for (const auto& huge : support::huge_polygons(tile.width, tile.height, seed)) {
                polygons.push_back(huge);
            }
            for (const auto& polygon : polygons) {
                SCOPED_TRACE(polygon.name);
                const auto& ring = polygon.rings.front();
                for (std::size_t i = 0; i + 1 < ring.size(); i += 1 + ring.size() / 12) {
                    for (const double offset : {0.0, 0.01, 0.70710678, 3.0, 20.0}) {
                        expect_laws(tile, ring[i], ring[i + 1], offset);
                    }
                }
            }
        }
    }
}

TEST(OffsetMesh, CoversSamplesAtExactlyTheOffset) {
    // For axis-parallel edges at pixel borders, samples lie exactly at the offset, and snapping to
    // halves moves the border by half a step in either direction.
    const Tile& tile = offset_tiles[0];
    for (const double nudge : {0.0, 1.0 / 512.0, -1.0 / 512.0, 1.0 / 1024.0}) {
        for (const double offset : {0.5, 1.5, 4.5}) {
            expect_laws(tile, {10.0, 10.0}, {30.0, 10.0}, offset + nudge);
            expect_laws(tile, {10.0, 30.0}, {10.0, 10.0}, offset + nudge);
            expect_laws(tile, {10.0 + nudge, 10.0 - nudge}, {30.0, 10.0 - nudge}, offset);
            expect_laws(tile, {10.5, 10.5}, {10.5, 10.5}, offset + 0.5 + nudge);
        }
    }
}

TEST(OffsetMesh, AcceptsEdgesOfAlmostNoLength) {
    const Tile& tile = offset_tiles[0];
    for (const double length : {0.0, 1e-300, 1e-160, 1e-12, 1e-3}) {
        expect_laws(tile, {20.25, 20.75}, {20.25 + length, 20.75}, 3.0);
        expect_laws(tile, {0.0, 0.0}, {-length, length}, 3.0);
    }
}

}  // namespace
}  // namespace nearfield
