#pragma once

#include <vulkan/vulkan_core.h>

namespace nearfield::graph {

/// The properties of an image format that the graph needs.
struct FormatTraits {
    VkFormat format = VK_FORMAT_UNDEFINED;
    const char* name = "";
    VkImageAspectFlags aspects = 0;

    [[nodiscard]] bool is_color() const { return (aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0; }
};

/// Null for a format that the graph does not know, and whose aspects it cannot determine.
[[nodiscard]] const FormatTraits* find_format(VkFormat format) noexcept;

}  // namespace nearfield::graph
