#pragma once

#include <engine/plan/edge_lists.hpp>

#include <shaders/compute_work.h>
#include <shaders/layout.h>

#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Elements of one kind in the array of words.
struct WorkRange {
    std::uint32_t first_word = 0;
    std::uint32_t count = 0;
};

/// The work of a tile batch of the compute technique, beyond edge lists and points.
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
