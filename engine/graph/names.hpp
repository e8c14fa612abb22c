#pragma once

#include <vulkan/vulkan_core.h>

#include <string>

/// Short Vulkan names as the graph prints them: bits joined by a plus, "none" for no bits, and a
/// number for values that the graph itself never sets.
namespace nearfield::graph {

[[nodiscard]] std::string stage_names(VkPipelineStageFlags stages);
[[nodiscard]] std::string access_names(VkAccessFlags access);
[[nodiscard]] std::string usage_names(VkImageUsageFlags usage);
[[nodiscard]] std::string layout_name(VkImageLayout layout);
[[nodiscard]] std::string format_name(VkFormat format);
[[nodiscard]] std::string extent_text(VkExtent2D extent);

}  // namespace nearfield::graph
