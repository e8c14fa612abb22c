#pragma once

#include <engine/graph/recorded_graph.hpp>
#include <engine/plan/tile_batch.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace nearfield::passes {

/// The parts in which passes of the raster technique bind the input of a tile batch.
namespace input_parts {
inline constexpr std::uint32_t tiles = 0;  ///< and groups of cells
inline constexpr std::uint32_t edges = 1;
inline constexpr std::uint32_t points = 2;
inline constexpr std::uint32_t field_points = 3;
}  // namespace input_parts

/// The parts of the samples of intersections.
namespace sample_parts {
inline constexpr std::uint32_t summaries = 0;  ///< by tile
inline constexpr std::uint32_t samples = 1;    ///< their number and list
}  // namespace sample_parts

/// What the passes of a tile batch are recorded from, beside the resources that they bind.
struct RecordContext {
    const plan::TileBatch& batch;
    VkBuffer mesh;
    VkDeviceSize mesh_offset;       ///< of the tile batch's vertices of meshes, in bytes
    VkDeviceSize tile_mesh_offset;  ///< of its vertices with the rectangle of their tile
    std::uint32_t shape_units;      ///< of the shapes before the work of fields and masks
    std::uint32_t sample_capacity;  ///< space in the read-back, in samples
};

/// The graph of a tile batch.
using TileGraph = graph::RecordedGraph<RecordContext>;

}  // namespace nearfield::passes
