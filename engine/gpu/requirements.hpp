#pragma once

#include <nearfield/requirements.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::gpu {

/// Throws StatusException (invalid_settings) if the api_version of the named structure is not a
/// version of Vulkan 1: one that was never set, or belongs to another API with the same numbering.
void require_vulkan_1(std::uint32_t api_version, const char* structure);

/// Fills in the base requirements: version, queue family, limits, formats, and everything unmet.
/// Handles must not be null. Creates nothing.
void survey_base(const PhysicalDevice& device, Requirements& requirements);

/// Fills in the optional parts; after survey_base().
void survey_optional_parts(const PhysicalDevice& device, Requirements& requirements);

/// Looks an entry point up by each name in turn: the core name, then its alias. Null if the loader
/// knows none.
template <class Function, class... Names>
[[nodiscard]] Function find_function(const PhysicalDevice& device, const Names*... names) {
    PFN_vkVoidFunction found = nullptr;
    static_cast<void>(((found = device.get_instance_proc_addr(device.instance, names)) || ...));
    return reinterpret_cast<Function>(found);
}

[[nodiscard]] std::vector<VkQueueFamilyProperties> queue_families(
    PFN_vkGetPhysicalDeviceQueueFamilyProperties get, VkPhysicalDevice device);

/// The combined depth-stencil format used for stencils; VK_FORMAT_UNDEFINED if the device has none
/// that can be an attachment.
[[nodiscard]] VkFormat find_stencil_format(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                                           VkPhysicalDevice physical_device);

/// A format of two floats that can be blended and sampled, the more precise one if there are
/// several; VK_FORMAT_UNDEFINED if the device has none.
[[nodiscard]] VkFormat find_gradient_format(PFN_vkGetPhysicalDeviceFormatProperties get_properties,
                                            VkPhysicalDevice physical_device);

}  // namespace nearfield::gpu
