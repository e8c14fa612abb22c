#pragma once

#include <engine/plan/edge_lists.hpp>
#include <engine/plan/gpu_layout.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// The work of a tile batch of the compute technique, beyond edge lists and points, in the layout
/// of shaders/masks.glsl (std430, 32-bit words). Coordinates are in sub-pixel steps from the tile's
/// low corner: the same snapped vertices that the raster technique would draw.
///
/// A mask has one bit per cell, in rows of whole words. Masks and other device-only data lie in the
/// device's scratch memory, at the word given.

/// Side of a block of a field tile, in cells; blocks at the tile's high borders may be smaller. At
/// most half a mask word, so that a row of a block lies in one word.
inline constexpr std::uint32_t block_side = 16;

/// Position and size of a mask.
struct MaskData {
    std::uint32_t first_word = 0;
    std::uint32_t words_per_row = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};
static_assert(sizeof(MaskData) == 16);

/// An edge that inverts the samples to its left (geometry::FillMesh::Piece).
struct MaskEdgeData {
    std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::uint32_t mask = 0;  ///< in ComputeWork::masks
};
static_assert(sizeof(MaskEdgeData) == 20);

/// A row of a mask in which edges have inverted samples.
struct MaskRowData {
    std::uint32_t first_word = 0;
    std::uint32_t words = 0;
};

/// An offset polygon: a triangle fan around its first corner.
struct MaskPolygonData {
    std::array<std::int32_t, 16> corners{};  ///< x, y of eight
    std::uint32_t overlap = 0;               ///< in ComputeWork::overlaps
    std::uint32_t run = 0;                   ///< of A's edges, in TileBatch::runs
};
static_assert(sizeof(MaskPolygonData) == 72);

/// An overlap tile.
struct OverlapData {
    std::uint32_t mask_a = 0;  ///< in ComputeWork::masks
    std::uint32_t mask_b = 0;
    /// Where the runs of the cells of A's boundary start in the scratch memory, one word per cell;
    /// no_runs if they are not requested.
    std::uint32_t first_run = 0;
    std::uint32_t tile = 0;  ///< in TileBatch::tiles
    std::uint32_t list = 0;  ///< 1: samples are listed; 0: only counted
};
static_assert(sizeof(OverlapData) == 20);
inline constexpr std::uint32_t no_runs = UINT32_MAX;

/// A row of an overlap tile.
struct OverlapRowData {
    std::uint32_t overlap = 0;
    std::uint32_t row = 0;
};

/// Elements of one kind in the array of words.
struct WorkRange {
    std::uint32_t first_word = 0;
    std::uint32_t count = 0;
};

/// An edge that can be nearest in a block, in cells relative to the block's low corner.
struct SegmentData {
    float middle_x = 0.0F, middle_y = 0.0F;
    float half_x = 0.0F, half_y = 0.0F;  ///< from the middle to an end
};
static_assert(sizeof(SegmentData) == 16);

/// A block of cells whose distances are requested.
struct BlockData {
    std::uint32_t first_segment = 0;  ///< in ComputeWork::segments
    std::uint32_t segments = 0;
    std::uint32_t size = 0;        ///< width | height << 16
    std::uint32_t tile_width = 0;  ///< from row to row in the read-back, in words
    std::uint32_t value = 0;       ///< where its low cell's value goes in the field's read-back
    std::uint32_t sign = 0;        ///< where the signs of its lowest row lie in the scratch memory
    std::uint32_t first_sign = 0;  ///< its low cell's bit in that word
    std::uint32_t words_per_row = 0;  ///< from row to row of signs
};
static_assert(sizeof(BlockData) == 32);

/// The compute work of a tile batch.
struct ComputeWork {
    std::vector<MaskData> masks;
    std::vector<MaskEdgeData> edges;
    std::vector<MaskRowData> rows;
    std::vector<MaskPolygonData> polygons_a;
    std::vector<MaskPolygonData> polygons_b;
    std::vector<OverlapData> overlaps;
    std::vector<OverlapRowData> overlap_rows;

    /// Blocks of field tiles (BlockEdges) and all their segments, block after block.
    std::vector<BlockData> blocks;
    std::vector<SegmentData> segments;
    /// Blocks whose cells or points need the nearest of the shape's own edges, each with edge lists
    /// relative to the tile. Where `features` is false, none of them writes features at cells.
    std::vector<TileData> feature_blocks;
    bool features = false;
    /// Points at which a field is reconstructed. They follow the lists in the geometry array:
    /// position in the tile; the block; the low one of the four surrounding cells (column | row <<
    /// 16, in the tile).
    std::vector<EdgeListWriter::Entry> points;

    std::uint64_t mask_words = 0;  ///< scratch memory starts with the masks, initially zero,
    std::uint64_t run_words = 0;   ///< then the runs of cells, initially all ones

    void clear();

    [[nodiscard]] std::uint64_t scratch_words() const { return mask_words + run_words; }

    /// Where each kind lies in one array of words, one kind after the other.
    struct Ranges {
        WorkRange masks, edges, rows, polygons_a, polygons_b, overlaps, overlap_rows;
        std::uint64_t words = 0;  ///< of all kinds together
    };
    [[nodiscard]] Ranges ranges() const;
};

}  // namespace nearfield::plan
