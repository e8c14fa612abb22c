#pragma once

#include <engine/graph/graph.hpp>

#include <vulkan/vulkan_core.h>

namespace nearfield::graph {

/// The Vulkan properties of an Access.
struct AccessTraits {
    const char* name = "";            ///< the name of the enumerator
    VkPipelineStageFlags stages = 0;  ///< where the pass accesses the resource
    VkAccessFlags read_access = 0;
    VkAccessFlags write_access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< images only
    VkImageUsageFlags usage = 0;                       ///< images only
    bool writes = false;  ///< declared by PassBuilder::write; all others by PassBuilder::read
    bool of_image = false;
    PassKind pass_kind{};

    [[nodiscard]] VkAccessFlags access() const { return read_access | write_access; }
};

[[nodiscard]] const AccessTraits& traits(Access access) noexcept;

/// The same on a queue family with these flags: without the stages and accesses that a family that
/// does not draw lacks. Nothing is left of an access by drawing.
[[nodiscard]] AccessTraits traits(Access access, VkQueueFlags queue) noexcept;
/// Of these stages or accesses those that such a family has.
[[nodiscard]] VkPipelineStageFlags stages_on(VkPipelineStageFlags stages,
                                             VkQueueFlags queue) noexcept;
[[nodiscard]] VkAccessFlags access_on(VkAccessFlags access, VkQueueFlags queue) noexcept;

}  // namespace nearfield::graph
