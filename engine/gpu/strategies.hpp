#pragma once

#include <nearfield/query.hpp>

#include <vulkan/vulkan_core.h>

#include <string>
#include <vector>

namespace nearfield::gpu {

/// The colour format of IntersectionStrategy::blend: one byte for the value of the paper's Table 1,
/// three for an edge's number.
inline constexpr VkFormat blend_format = VK_FORMAT_R8G8B8A8_UNORM;

/// A device's support for what strategies need beyond the base.
struct StrategySupport {
    bool logic_op = false;              ///< the feature is enabled
    VkFormatFeatureFlags blending = 0;  ///< of blend_format with optimal tiling
};

/// The support of a physical device; the argument states whether its feature logicOp is enabled.
[[nodiscard]] StrategySupport strategy_support(
    PFN_vkGetPhysicalDeviceFormatProperties get_properties, VkPhysicalDevice physical_device,
    bool logic_op);

/// The requirements of a strategy that the device does not meet, one text each; empty if the
/// strategy is available. The only place that defines what strategies need.
[[nodiscard]] std::vector<std::string> missing_for(IntersectionStrategy strategy,
                                                   const StrategySupport& support);

}  // namespace nearfield::gpu
