#include <engine/graph/format.hpp>
#include <engine/graph/names.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace nearfield::graph {

namespace {

struct Bit {
    std::uint32_t bit = 0;
    const char* name = "";
};

constexpr std::array stage_bits = {
    Bit{VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, "indirect"},
    Bit{VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, "vertex-input"},
    Bit{VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, "vertex"},
    Bit{VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT, "early-tests"},
    Bit{VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, "fragment"},
    Bit{VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT, "late-tests"},
    Bit{VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, "color-output"},
    Bit{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, "compute"},
    Bit{VK_PIPELINE_STAGE_TRANSFER_BIT, "transfer"},
    Bit{VK_PIPELINE_STAGE_HOST_BIT, "host"},
};

constexpr std::array access_bits = {
    Bit{VK_ACCESS_INDIRECT_COMMAND_READ_BIT, "indirect-read"},
    Bit{VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT, "vertex-read"},
    Bit{VK_ACCESS_SHADER_READ_BIT, "shader-read"},
    Bit{VK_ACCESS_SHADER_WRITE_BIT, "shader-write"},
    Bit{VK_ACCESS_COLOR_ATTACHMENT_READ_BIT, "color-read"},
    Bit{VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, "color-write"},
    Bit{VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT, "depth-stencil-read"},
    Bit{VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, "depth-stencil-write"},
    Bit{VK_ACCESS_TRANSFER_READ_BIT, "transfer-read"},
    Bit{VK_ACCESS_TRANSFER_WRITE_BIT, "transfer-write"},
    Bit{VK_ACCESS_HOST_READ_BIT, "host-read"},
};

constexpr std::array usage_bits = {
    Bit{VK_IMAGE_USAGE_SAMPLED_BIT, "sampled"},
    Bit{VK_IMAGE_USAGE_STORAGE_BIT, "storage"},
    Bit{VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, "color-attachment"},
    Bit{VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, "depth-stencil-attachment"},
};

void append(std::string& list, const std::string& name) {
    if (!list.empty()) {
        list += '+';
    }
    list += name;
}

std::string join(std::uint32_t bits, std::span<const Bit> names) {
    std::string text;
    for (const Bit& name : names) {
        if ((bits & name.bit) != 0) {
            append(text, name.name);
            bits &= ~name.bit;
        }
    }
    if (bits != 0) {
        append(text, std::to_string(bits));
    }
    return text.empty() ? "none" : text;
}

}  // namespace

std::string stage_names(VkPipelineStageFlags stages) {
    return join(stages, stage_bits);
}

std::string access_names(VkAccessFlags access) {
    return join(access, access_bits);
}

std::string usage_names(VkImageUsageFlags usage) {
    return join(usage, usage_bits);
}

std::string layout_name(VkImageLayout layout) {
    switch (layout) {
        case VK_IMAGE_LAYOUT_UNDEFINED:
            return "undefined";
        case VK_IMAGE_LAYOUT_GENERAL:
            return "general";
        case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
            return "color-attachment";
        case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
            return "depth-stencil-attachment";
        case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
            return "shader-read-only";
        default:
            return std::to_string(layout);
    }
}

std::string format_name(VkFormat format) {
    const FormatTraits* const known = find_format(format);
    return known != nullptr ? known->name : std::to_string(format);
}

std::string extent_text(VkExtent2D extent) {
    return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

}  // namespace nearfield::graph
