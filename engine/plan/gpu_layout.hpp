#pragma once

#include <cstddef>
#include <cstdint>

namespace nearfield::plan {

/// Structures that compute shaders read and write; shaders/layout.glsl declares the same ones
/// (std430). Lengths are in cells of the tile, positions relative to its low corner.

inline constexpr std::uint32_t no_feature = UINT32_MAX;  ///< in an id image: nothing was drawn
/// Where features share their image with signs, ids are below this value, and the value itself
/// means that nothing was drawn.
inline constexpr std::uint32_t max_signed_features = (1U << 24U) - 1U;
inline constexpr std::uint32_t cluster_size = 8;  ///< edges per bounding box

/// A list of edges in the geometry array, in clusters: `count` edges (EdgeData) starting at
/// `edges`, and, starting at `clusters`, one box (low corner, high corner) for every cluster_size
/// edges. Both are even indices of 2-vectors.
struct EdgeListData {
    std::uint32_t clusters = 0;
    std::uint32_t edges = 0;
    std::uint32_t count = 0;
};

/// Replaces a position in the read-back for an output that is not requested.
inline constexpr std::uint32_t not_asked = UINT32_MAX;

struct TileData {
    std::uint32_t atlas_x = 0;  ///< for a block of a tile (ComputeWork): its column in that tile
    std::uint32_t atlas_y = 0;  ///< and its row
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    EdgeListData nearest;   ///< every edge that can be nearest to a needed sample
    EdgeListData crossing;  ///< every edge that a ray towards +x from inside the tile can cross
    float settled = 0.0F;   ///< farther than this from B's boundary, a sample has its cell's sign
    float margin = 0.0F;    ///< two distances that differ by less count as equal
    std::uint32_t outside = 0;  ///< 1: points outside B are resolved as well
    // For a block of a field tile only:
    std::uint32_t tile_width = 0;  ///< of that tile, in cells
    std::uint32_t mask = 0;        ///< where its fill mask starts, in words of the scratch memory
    std::uint32_t first_feature = not_asked;  ///< where its features start in the field's read-back
};
static_assert(sizeof(TileData) == 64);

/// A rectangle of cells of a drawn tile that one workgroup works on. They follow the tiles in their
/// buffer.
struct CellGroup {
    std::uint32_t tile = 0;
    std::uint32_t cell = 0;  ///< the low one, column | row << 16
    /// Of a field: where the tile's values and features start in the read-back, or not_asked. Of an
    /// overlap: 1 if samples are listed; where the hits of the cells are kept, or not_asked.
    std::uint32_t first = 0, second = 0;
};
static_assert(sizeof(CellGroup) == 16 && sizeof(TileData) % sizeof(CellGroup) == 0);
/// Sides of these rectangles.
inline constexpr std::uint32_t field_group_side = 8;
inline constexpr std::uint32_t overlap_group_width = 16;
inline constexpr std::uint32_t overlap_group_height = 32;

/// A straight edge: an exact edge, or a simplified edge that represents a run of B's edges.
struct EdgeData {
    float ax = 0.0F, ay = 0.0F, bx = 0.0F, by = 0.0F;
    std::uint32_t run = 0;  ///< where the run's count + 1 vertices start in the geometry array
    std::uint32_t run_count = 1;   ///< edges in the run; 1: the edge itself
    float deviation = 0.0F;        ///< largest distance of the run from the edge
    std::uint32_t first_edge = 0;  ///< index of the run's first edge in B
};
static_assert(sizeof(EdgeData) == 32);

/// A point whose depth is requested, or at which a field is reconstructed.
struct PointData {
    float x = 0.0F, y = 0.0F;
    std::uint32_t tile = 0;
    std::uint32_t cell = 0;  ///< of a field: the low one of the four around, column | row << 16
};
static_assert(sizeof(PointData) == 16);

/// A resolved point or cell, one word: B's nearest edge and three flags. Zero: outside, not
/// resolved.
inline constexpr std::uint32_t point_inside = 1U << 31U;
inline constexpr std::uint32_t point_unique = 1U << 30U;
inline constexpr std::uint32_t point_resolved = 1U << 29U;
inline constexpr std::uint32_t point_doubtful = 1U << 28U;  ///< the CPU has to decide
inline constexpr std::uint32_t point_edge_mask = (1U << 28U) - 1U;

/// Details of a resolved point that stays on the device (shaders/details.glsl). They follow the
/// words of all points of the tile batch.
struct PointDetails {
    float offset_x = 0.0F, offset_y = 0.0F;  ///< from the point to the nearest one, cells
    float along = 0.0F;      ///< the nearest edge: 0 at its first vertex, 1 at its last
    std::uint32_t wall = 0;  ///< at the point of contact: the edge's outward normal, packSnorm2x16
};
static_assert(sizeof(PointDetails) == 16);

/// Values of an intersection's image: the low byte holds the colour of the paper's Table 1, in
/// which white means that both shapes cover the sample; the bits above it hold a run of A's edges
/// where A takes part by its boundary.
inline constexpr std::uint32_t white = 0xff;
inline constexpr std::uint32_t run_shift = 8;
inline constexpr std::uint32_t max_runs = 1U << (32U - run_shift);

/// The samples that an intersection found in a tile: their number and the box of their cells, both
/// corners included; the box is meaningful where count > 0.
struct TileSummary {
    std::uint32_t count = 0;
    std::uint32_t low_column = UINT32_MAX, low_row = UINT32_MAX;
    std::uint32_t high_column = 0, high_row = 0;
    /// 0: no sample passed the occlusion query, so there is nothing to search for. Stays 1 in tiles
    /// without an occlusion query.
    std::uint32_t passed = 1;
};
static_assert(sizeof(TileSummary) == 24 && offsetof(TileSummary, passed) == 20);

/// A sample found by an intersection.
struct SampleData {
    std::uint32_t cell = 0;  ///< column | row << 16, within the tile
    std::uint32_t tile = 0;
    std::uint32_t run = 0;  ///< in TileBatch::runs, where A takes part by its boundary
};
static_assert(sizeof(SampleData) == 12);

}  // namespace nearfield::plan
