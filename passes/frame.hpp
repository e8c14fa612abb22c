#pragma once

#include <engine/plan/round.hpp>

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nearfield::passes {

inline constexpr std::size_t sign_encodings = 3;

/// What all passes record from. One object lives as long as the passes; its contents change from
/// round to round while commands are recorded.
struct Frame {
    const plan::Round* round = nullptr;
    VkBuffer mesh = VK_NULL_HANDLE;
    VkDeviceSize mesh_offset = 0;             ///< where the round's mesh starts, in bytes
    VkDescriptorSet points = VK_NULL_HANDLE;  ///< of the raster: with images
    /// Points of the compute technique. Not the raster's set: that names images of whichever recipe
    /// was last, and a driver may look at all that a set names.
    VkDescriptorSet points_by_lists = VK_NULL_HANDLE;
    VkDescriptorSet field[sign_encodings]{};  ///< by sign encoding
    VkDescriptorSet gradients = VK_NULL_HANDLE;
    std::array<VkDescriptorSet, intersection_strategies> samples{};  ///< by strategy
    VkDescriptorSet masks = VK_NULL_HANDLE;                          ///< of the compute technique
    VkDescriptorSet blocks = VK_NULL_HANDLE;                         ///< of the compute technique
    VkDescriptorSet feature_blocks = VK_NULL_HANDLE;                 ///< of the compute technique
    VkBuffer scratch = VK_NULL_HANDLE;  ///< the compute technique's scratch memory
    std::uint32_t subpixel_bits = 8;    ///< of the grid that vertices are snapped to
    VkBuffer read_back = VK_NULL_HANDLE;
    VkDeviceSize summaries_offset = 0;  ///< of the summaries in the read-back, in bytes
    std::uint32_t sample_capacity = 0;  ///< samples that the read-back has room for
};

}  // namespace nearfield::passes
