#pragma once

#include <vulkan/vulkan_core.h>

namespace nearfield::graph {

/// What the graph has to know about the format of an image.
struct FormatTraits {
    VkFormat format = VK_FORMAT_UNDEFINED;
    const char* name = "";
    VkImageAspectFlags aspects = 0;

    [[nodiscard]] bool is_color() const { return (aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0; }
};

/// Null for a format that the graph does not know: it could not tell its aspects.
[[nodiscard]] const FormatTraits* find_format(VkFormat format) noexcept;

}  // namespace nearfield::graph
