#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::gpu {

/// What the base needs of a physical device and `queue_family` lacks, one text each; empty where it
/// suffices. Creates nothing.
[[nodiscard]] std::vector<std::string> missing_requirements(PFN_vkGetInstanceProcAddr get,
                                                            VkInstance instance,
                                                            VkPhysicalDevice physical_device,
                                                            std::uint32_t queue_family);

/// The combined depth-stencil format to use for stencils, VK_FORMAT_UNDEFINED where the device has
/// none that can be an attachment.
[[nodiscard]] VkFormat find_stencil_format(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                                           VkPhysicalDevice physical_device);

/// A format of two floats that can be blended and sampled, the more precise one if there is a
/// choice; VK_FORMAT_UNDEFINED where the device has none.
[[nodiscard]] VkFormat find_gradient_format(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                                            VkPhysicalDevice physical_device);

}  // namespace nearfield::gpu
