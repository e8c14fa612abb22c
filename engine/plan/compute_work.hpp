#pragma once

#include <engine/plan/field_tiles.hpp>

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

    FieldWork fields;

    std::uint64_t mask_words = 0;  ///< scratch memory starts with the masks, initially zero,
    std::uint64_t run_words = 0;   ///< then the runs of cells, initially all ones; then the lists
                                   ///< of fields

    void clear();

    [[nodiscard]] FieldLists field_lists() const { return {fields, mask_words + run_words}; }
    [[nodiscard]] std::uint64_t scratch_words() const { return field_lists().end; }

    /// Where each kind lies in one array of words, one kind after the other.
    struct Ranges {
        WorkRange masks, edges, rows, polygons_a, polygons_b, overlaps, overlap_rows;
        std::uint64_t words = 0;  ///< of all kinds together
    };
    [[nodiscard]] Ranges ranges() const;
};

}  // namespace nearfield::plan
