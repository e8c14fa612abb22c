#pragma once

#include <engine/graph/graph.hpp>

#include <vulkan/vulkan_core.h>

namespace nearfield::graph {

/// All that Vulkan wants to know about an Access.
struct AccessTraits {
    const char* name = "";            ///< as it stands in the enumeration
    VkPipelineStageFlags stages = 0;  ///< where the pass touches the resource
    VkAccessFlags read_access = 0;
    VkAccessFlags write_access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< images only
    VkImageUsageFlags usage = 0;                       ///< images only
    bool writes = false;  ///< is declared by PassBuilder::write; all others by PassBuilder::read
    bool of_image = false;
    PassKind pass_kind{};

    [[nodiscard]] VkAccessFlags access() const { return read_access | write_access; }
};

[[nodiscard]] const AccessTraits& traits(Access access) noexcept;

}  // namespace nearfield::graph
