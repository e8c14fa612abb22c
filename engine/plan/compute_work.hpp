#pragma once

#include <engine/plan/edge_lists.hpp>
#include <engine/plan/gpu_layout.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// What a round of the compute technique takes beside edge lists and points, as shaders/masks.glsl
/// declares it (std430, words of 32 bits). Coordinates are in sub-pixel steps from the tile's low
/// corner: the snapped vertices that the raster would draw.
///
/// A mask is a bit a cell, rows of whole words. Masks and other things that live on the device
/// alone lie in its scratch memory, at the word that is named.

/// Cells along a side of a block of a field tile, but for those at its high borders. At most half a
/// word of a mask, so that a row of a block lies in one word.
inline constexpr std::uint32_t block_side = 16;

/// Where a mask lies.
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

/// A row of a mask that edges have inverted samples of.
struct MaskRowData {
    std::uint32_t first_word = 0;
    std::uint32_t words = 0;
};

/// An offset polygon: the fan of triangles around its first corner.
struct MaskPolygonData {
    std::array<std::int32_t, 16> corners{};  ///< x, y of eight
    std::uint32_t overlap = 0;               ///< in ComputeWork::overlaps
    std::uint32_t run = 0;                   ///< of A's edges, in Round::runs
};
static_assert(sizeof(MaskPolygonData) == 72);

/// An overlap tile.
struct OverlapData {
    std::uint32_t mask_a = 0;  ///< in ComputeWork::masks
    std::uint32_t mask_b = 0;
    /// Where the run of every cell of A's boundary lies in the scratch memory, a word a cell;
    /// no_runs where nobody asks for it.
    std::uint32_t first_run = 0;
    std::uint32_t tile = 0;  ///< in Round::tiles
    std::uint32_t list = 0;  ///< 1: the samples are listed, not counted only
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

/// A block whose cells want their distances.
struct BlockData {
    std::uint32_t first_segment = 0;  ///< in ComputeWork::segments
    std::uint32_t segments = 0;
    std::uint32_t size = 0;        ///< width | height << 16
    std::uint32_t tile_width = 0;  ///< from row to row in the read-back, in words
    std::uint32_t value = 0;       ///< where its low cell's value goes in the field's read-back
    std::uint32_t sign = 0;        ///< where the signs of its lowest row lie in the scratch memory
    std::uint32_t first_sign = 0;  ///< in that word, its low cell's bit
    std::uint32_t words_per_row = 0;  ///< from row to row of signs
};
static_assert(sizeof(BlockData) == 32);

/// The work of a round.
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
    /// Blocks whose cells or points want the nearest of the shape's own edges, each with lists of
    /// them relative to the tile; none of them has features at cells where `features` is false.
    std::vector<TileData> feature_blocks;
    bool features = false;
    /// Points at which a field is reconstructed; they stand in the geometry array, behind the
    /// lists: position in the tile; the block, the low one of the four cells around (column | row
    /// << 16, in the tile).
    std::vector<EdgeListWriter::Entry> points;

    std::uint64_t mask_words = 0;  ///< scratch memory starts with the masks, all zero at first,
    std::uint64_t run_words = 0;   ///< then the runs of cells, all ones at first

    void clear();

    [[nodiscard]] std::uint64_t scratch_words() const { return mask_words + run_words; }

    /// Where each kind stands in one array of words, one after the other.
    struct Ranges {
        WorkRange masks, edges, rows, polygons_a, polygons_b, overlaps, overlap_rows;
        std::uint64_t words = 0;  ///< of all together
    };
    [[nodiscard]] Ranges ranges() const;
};

}  // namespace nearfield::plan
