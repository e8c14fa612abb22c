#include <engine/gpu/strategies.hpp>

#include <array>

namespace nearfield::gpu {

StrategySupport strategy_support(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                                 VkPhysicalDevice physical_device, bool logic_op) {
    VkFormatProperties properties{};
    get_properties(physical_device, blend_format, &properties);
    return {logic_op, properties.optimalTilingFeatures};
}

std::vector<std::string> missing_for(IntersectionStrategy strategy,
                                     const StrategySupport& support) {
    std::vector<std::string> missing;
    if (strategy == IntersectionStrategy::logic_op && !support.logic_op) {
        missing.emplace_back(
            "feature logicOp: the device does not offer it or was not created with it enabled, and "
            "A's colour is combined with B's by the operation OR");
    }
    if (strategy == IntersectionStrategy::blend) {
        struct Requirement {
            VkFormatFeatureFlags feature;
            const char* name;
            const char* why;
        };
        constexpr std::array<Requirement, 3> table{{
            {VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT",
             "both shapes are drawn to it"},
            {VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT,
             "VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT", "A's colour is added to B's"},
            {VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, "VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT",
             "the sums are read by a compute pass"},
        }};
        for (const Requirement& row : table) {
            if ((support.blending & row.feature) == 0) {
                missing.push_back(
                    std::string("format VK_FORMAT_R8G8B8A8_UNORM: optimal tiling lacks ") +
                    row.name + ", and " + row.why);
            }
        }
    }
    return missing;
}

}  // namespace nearfield::gpu
