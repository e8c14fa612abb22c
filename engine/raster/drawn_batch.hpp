#pragma once

#include <engine/device_input/tile_batch.hpp>
#include <engine/geometry/mesh.hpp>
#include <engine/raster/atlas.hpp>
#include <engine/raster/edge_lists.hpp>
#include <nearfield/query.hpp>

#include <shaders/layout.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::raster {

inline constexpr std::size_t sign_encodings = 3;

/// Consecutive vertices.
struct DrawRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// A vertex with the rectangle of its tile, in pixels of the atlas. The triangles of a distance
/// mesh reach far over other tiles: what is outside the rectangle is discarded.
struct TileVertex {
    geometry::MeshVertex vertex;
    std::uint16_t x = 0, y = 0, width = 0, height = 0;
};

/// What one draw of an intersection takes.
enum class OverlapStep : std::uint8_t {
    clear,       ///< rectangles of all tiles
    parity_b,    ///< fills of B where it is a volume
    volume_b,    ///< rectangles of the same tiles
    boundary_b,  ///< offset polygons of B where its boundary takes part
    parity_a,
    volume_a,
    boundary_a,
    watched_a,  ///< the rectangle or the offset polygons of A in tiles with an occlusion query
};
inline constexpr std::size_t overlap_steps = 8;

/// One of the meshes of a tile batch.
struct MeshId {
    std::size_t index = 0;
};

/// Rectangles of the distance tiles with an encoding of the sign, at depth 1.
[[nodiscard]] constexpr MeshId rectangles_of(SignEncoding sign) {
    return {static_cast<std::size_t>(sign)};
}
/// Fills of B in these tiles.
[[nodiscard]] constexpr MeshId fills_of(SignEncoding sign) {
    return {sign_encodings + static_cast<std::size_t>(sign)};
}
[[nodiscard]] constexpr MeshId overlaps_of(IntersectionStrategy strategy, OverlapStep step) {
    return {2 * sign_encodings + overlap_steps * static_cast<std::size_t>(strategy) +
            static_cast<std::size_t>(step)};
}
inline constexpr std::size_t tile_batch_meshes =
    2 * sign_encodings + intersection_strategies * overlap_steps;

/// One of the meshes of TileVertex of a tile batch.
enum class TileMeshId : std::uint8_t {
    distances,         ///< distance meshes, below depth 1
    signed_distances,  ///< the same of SignEncoding::feature_bit
    gradients,  ///< rectangles of tiles with blended gradients; ids: where their values start
};
inline constexpr std::size_t tile_batch_tile_meshes = 3;

/// The triangles of a tile batch: a mesh for each draw, which holds those of all tiles. Positions
/// are in pixels of the atlas. Tiles are so far apart (atlas_gap) that no triangle without the
/// rectangle of its tile reaches another tile.
class TileMeshes {
public:
    void clear();

    [[nodiscard]] geometry::Mesh& operator[](MeshId id) { return meshes_[id.index]; }
    [[nodiscard]] const geometry::Mesh& operator[](MeshId id) const { return meshes_[id.index]; }
    [[nodiscard]] std::vector<TileVertex>& operator[](TileMeshId id) {
        return tile_meshes_[static_cast<std::size_t>(id)];
    }

    /// All meshes, in the order in which they are uploaded.
    [[nodiscard]] std::span<const geometry::Mesh> meshes() const { return meshes_; }
    [[nodiscard]] std::span<const std::vector<TileVertex>> tile_meshes() const {
        return tile_meshes_;
    }
    /// A mesh among the vertices of meshes(), or all from `first` to `last`.
    [[nodiscard]] DrawRange range(MeshId id) const { return range(id, id); }
    [[nodiscard]] DrawRange range(MeshId first, MeshId last) const;
    /// A mesh among the vertices of tile_meshes().
    [[nodiscard]] DrawRange range(TileMeshId id) const;

private:
    std::array<geometry::Mesh, tile_batch_meshes> meshes_;
    std::array<std::vector<TileVertex>, tile_batch_tile_meshes> tile_meshes_;
};

/// Maximum number of occlusion queries of a tile batch, each of which costs a draw.
inline constexpr std::uint32_t max_watched = 4;

/// An overlap tile with an occlusion query around A's last draw into it.
struct WatchedTile {
    std::uint32_t tile = 0;  ///< in DrawnBatch::tiles
    IntersectionStrategy strategy{};
    device_input::Part part_a{};
    DrawRange a;  ///< in the mesh OverlapStep::watched_a of the strategy
};

/// One of the lists of cell groups of a tile batch: of its fields with an encoding of the sign, or
/// of its intersections by a strategy.
[[nodiscard]] constexpr std::size_t group_list(SignEncoding sign) {
    return static_cast<std::size_t>(sign);
}
[[nodiscard]] constexpr std::size_t group_list(IntersectionStrategy strategy) {
    return sign_encodings + static_cast<std::size_t>(strategy);
}
inline constexpr std::size_t group_lists = sign_encodings + intersection_strategies;

/// A tile batch that is drawn.
struct DrawnBatch : device_input::TileBatch {
    EdgeListWriter lists;
    TileMeshes meshes;
    TileSize extent;  ///< of the atlas that the tiles take
    std::array<std::vector<shaders::CellGroup>, group_lists> groups;
    /// By strategy.
    std::array<std::vector<device_input::OverlapTile>, intersection_strategies> overlaps;
    /// Tiles of the plan that are worth an occlusion query, by size.
    std::vector<std::uint32_t> largest;
    std::vector<WatchedTile> watched;  ///< by occlusion query
    std::vector<shaders::TilePointData> field_points;

    /// Position of a list's first group in the buffer of tiles, in units of a group.
    [[nodiscard]] std::uint32_t first_group(std::size_t list) const;
    void clear();
};

}  // namespace nearfield::raster
