#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/plan/tile_batch.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::plan {

/// The tile at depth 1, as two triangles in the atlas.
[[nodiscard]] std::array<geometry::MeshVertex, 6> rectangle_of(const Tile& tile, std::uint32_t id);
void add_rectangle(const Tile& tile, geometry::Mesh& mesh);

/// Moves vertices, from `first` on, from cells of a tile to its place in the atlas.
void move_to_atlas(const Tile& tile, std::size_t first, geometry::Mesh& mesh);

[[nodiscard]] inline TileVertex in_tile(const Tile& tile, const geometry::MeshVertex& vertex) {
    return {vertex, static_cast<std::uint16_t>(tile.place.x),
            static_cast<std::uint16_t>(tile.place.y), static_cast<std::uint16_t>(tile.width),
            static_cast<std::uint16_t>(tile.height)};
}

/// Appends groups of width x height cells that cover a tile; `first` describes the low one.
void add_groups(const Tile& tile, std::uint32_t width, std::uint32_t height, CellGroup first,
                std::vector<CellGroup>& groups);

}  // namespace nearfield::plan
