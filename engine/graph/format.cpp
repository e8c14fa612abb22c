#include <engine/graph/format.hpp>

#include <algorithm>
#include <array>

namespace nearfield::graph {

namespace {

constexpr VkImageAspectFlags color = VK_IMAGE_ASPECT_COLOR_BIT;
constexpr VkImageAspectFlags depth = VK_IMAGE_ASPECT_DEPTH_BIT;
constexpr VkImageAspectFlags stencil = VK_IMAGE_ASPECT_STENCIL_BIT;

constexpr std::array formats = {
    FormatTraits{VK_FORMAT_R8_UNORM, "R8_UNORM", color},
    FormatTraits{VK_FORMAT_R8_UINT, "R8_UINT", color},
    FormatTraits{VK_FORMAT_R8G8B8A8_UNORM, "R8G8B8A8_UNORM", color},
    FormatTraits{VK_FORMAT_R16G16_SFLOAT, "R16G16_SFLOAT", color},
    FormatTraits{VK_FORMAT_R32_UINT, "R32_UINT", color},
    FormatTraits{VK_FORMAT_R32_SFLOAT, "R32_SFLOAT", color},
    FormatTraits{VK_FORMAT_R32G32_SFLOAT, "R32G32_SFLOAT", color},
    FormatTraits{VK_FORMAT_D32_SFLOAT, "D32_SFLOAT", depth},
    FormatTraits{VK_FORMAT_D24_UNORM_S8_UINT, "D24_UNORM_S8_UINT", depth | stencil},
    FormatTraits{VK_FORMAT_D32_SFLOAT_S8_UINT, "D32_SFLOAT_S8_UINT", depth | stencil},
};

}  // namespace

const FormatTraits* find_format(VkFormat format) noexcept {
    const auto* const found =
        std::find_if(formats.begin(), formats.end(),
                     [format](const FormatTraits& known) { return known.format == format; });
    return found == formats.end() ? nullptr : found;
}

}  // namespace nearfield::graph
