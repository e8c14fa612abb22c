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
    FormatTraits{VK_FORMAT_R8G8_UNORM, "R8G8_UNORM", color},
    FormatTraits{VK_FORMAT_R8G8_UINT, "R8G8_UINT", color},
    FormatTraits{VK_FORMAT_R8G8B8A8_UNORM, "R8G8B8A8_UNORM", color},
    FormatTraits{VK_FORMAT_R8G8B8A8_UINT, "R8G8B8A8_UINT", color},
    FormatTraits{VK_FORMAT_B8G8R8A8_UNORM, "B8G8R8A8_UNORM", color},
    FormatTraits{VK_FORMAT_R16_UINT, "R16_UINT", color},
    FormatTraits{VK_FORMAT_R16_SINT, "R16_SINT", color},
    FormatTraits{VK_FORMAT_R16_SFLOAT, "R16_SFLOAT", color},
    FormatTraits{VK_FORMAT_R16G16_UINT, "R16G16_UINT", color},
    FormatTraits{VK_FORMAT_R16G16_SFLOAT, "R16G16_SFLOAT", color},
    FormatTraits{VK_FORMAT_R16G16B16A16_UINT, "R16G16B16A16_UINT", color},
    FormatTraits{VK_FORMAT_R16G16B16A16_SFLOAT, "R16G16B16A16_SFLOAT", color},
    FormatTraits{VK_FORMAT_R32_UINT, "R32_UINT", color},
    FormatTraits{VK_FORMAT_R32_SINT, "R32_SINT", color},
    FormatTraits{VK_FORMAT_R32_SFLOAT, "R32_SFLOAT", color},
    FormatTraits{VK_FORMAT_R32G32_UINT, "R32G32_UINT", color},
    FormatTraits{VK_FORMAT_R32G32_SINT, "R32G32_SINT", color},
    FormatTraits{VK_FORMAT_R32G32_SFLOAT, "R32G32_SFLOAT", color},
    FormatTraits{VK_FORMAT_R32G32B32A32_UINT, "R32G32B32A32_UINT", color},
    FormatTraits{VK_FORMAT_R32G32B32A32_SINT, "R32G32B32A32_SINT", color},
    FormatTraits{VK_FORMAT_R32G32B32A32_SFLOAT, "R32G32B32A32_SFLOAT", color},
    FormatTraits{VK_FORMAT_D16_UNORM, "D16_UNORM", depth},
    FormatTraits{VK_FORMAT_X8_D24_UNORM_PACK32, "X8_D24_UNORM_PACK32", depth},
    FormatTraits{VK_FORMAT_D32_SFLOAT, "D32_SFLOAT", depth},
    FormatTraits{VK_FORMAT_S8_UINT, "S8_UINT", stencil},
    FormatTraits{VK_FORMAT_D16_UNORM_S8_UINT, "D16_UNORM_S8_UINT", depth | stencil},
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
