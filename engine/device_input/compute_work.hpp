#pragma once

#include <engine/device_input/field_tiles.hpp>
#include <engine/queries/regions.hpp>

#include <shaders/compute_work.h>
#include <shaders/layout.h>

#include <cstdint>
#include <vector>

namespace nearfield::device_input {

/// Memory for `masks` bit masks of the grids of regions, one bit per cell in rows of whole words.
[[nodiscard]] double bytes_of_masks(const queries::Regions& regions, int masks,
                                    double largest_tile);

/// The work of a tile batch of the compute technique.
struct ComputeWork {
    std::vector<shaders::MaskShapeData> mask_shapes;
    std::vector<shaders::OverlapData> overlaps;
    FieldWork fields;
    /// The input starts with these; they outlive the upload of the batch.
    const SearchShapes* shapes = nullptr;

    std::uint32_t mask_threads = 0;  ///< of all shapes in masks
    std::uint32_t overlap_rows = 0;
    std::uint64_t mask_words = 0;  ///< scratch memory starts with the masks, initially zero,
    std::uint64_t edge_words = 0;  ///< then the edges of cells, initially all ones; then the lists
                                   ///< of fields

    void clear();

    /// Of the input that starts with the shapes.
    [[nodiscard]] std::uint64_t shape_bytes() const;
    [[nodiscard]] FieldLists field_lists() const { return {fields, mask_words + edge_words}; }
    [[nodiscard]] std::uint64_t scratch_words() const { return field_lists().end; }
};

}  // namespace nearfield::device_input
