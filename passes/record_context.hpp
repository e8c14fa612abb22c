#pragma once

#include <engine/graph/recorded_graph.hpp>
#include <engine/plan/tile_batch.hpp>

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nearfield::passes {

/// The descriptor sets of the compute passes of a tile batch.
struct TileBatchSets {
    VkDescriptorSet points = VK_NULL_HANDLE;  ///< raster technique: with images
    /// Compute technique: without images. It is not the raster's set, which names images of the
    /// last compiled graph, because a driver may access every resource that a set names.
    VkDescriptorSet points_by_lists = VK_NULL_HANDLE;
    VkDescriptorSet field[plan::sign_encodings]{};  ///< by sign encoding
    VkDescriptorSet gradients = VK_NULL_HANDLE;
    std::array<VkDescriptorSet, intersection_strategies> samples{};  ///< by strategy
    VkDescriptorSet masks = VK_NULL_HANDLE;                          ///< of the compute technique
    VkDescriptorSet fields = VK_NULL_HANDLE;                         ///< of shapes in tiles
    VkDescriptorSet places = VK_NULL_HANDLE;                         ///< fields place by place

    [[nodiscard]] VkDescriptorSet field_by(SignEncoding encoding) const {
        return field[static_cast<std::size_t>(encoding)];
    }
};

/// What the passes of a tile batch are recorded from.
struct RecordContext {
    const plan::TileBatch& batch;
    const TileBatchSets& sets;
    VkBuffer mesh;
    VkDeviceSize mesh_offset;       ///< of the tile batch's vertices of meshes, in bytes
    VkDeviceSize tile_mesh_offset;  ///< of its vertices with the rectangle of their tile
    VkBuffer scratch;               ///< the compute technique's scratch memory
    std::uint32_t shape_units;      ///< of the shapes before the work of fields and masks
    VkBuffer crowd;                 ///< arguments of its dispatch for crowded blocks
    VkBuffer read_back;
    VkDeviceSize summaries_offset;  ///< offset of the summaries in the read-back, in bytes
    std::uint32_t sample_capacity;  ///< space in the read-back, in samples
};

/// The graph of a tile batch.
using TileGraph = graph::RecordedGraph<RecordContext>;

}  // namespace nearfield::passes
