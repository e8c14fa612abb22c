#pragma once

#include <nearfield/query.hpp>

#include <vulkan/vulkan_core.h>

#include <string>
#include <vector>

namespace nearfield::gpu {

/// The colour of IntersectionStrategy::blend: Table 1's value and the three bytes of an edge's
/// number beside it.
inline constexpr VkFormat blend_format = VK_FORMAT_R8G8B8A8_UNORM;

/// What a device has of that which strategies need beyond the base.
struct StrategySupport {
    bool logic_op = false;              ///< the feature, as enabled
    VkFormatFeatureFlags blending = 0;  ///< of blend_format with optimal tiling
};

/// The support of a physical device whose feature logicOp is enabled or not, as stated.
[[nodiscard]] StrategySupport strategy_support(
    PFN_vkGetPhysicalDeviceFormatProperties get_properties, VkPhysicalDevice physical_device,
    bool logic_op);

/// What a strategy needs and the support lacks, one text each; empty where it is available. The one
/// place that knows what strategies need.
[[nodiscard]] std::vector<std::string> missing_for(IntersectionStrategy strategy,
                                                   const StrategySupport& support);

}  // namespace nearfield::gpu
