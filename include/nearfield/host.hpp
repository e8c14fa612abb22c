#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

/// \file
/// What a Vulkan host hands over.

namespace nearfield {

/// A host's Vulkan objects. nearfield borrows them: they must outlive the context, and are never
/// destroyed by it.
///
/// Context::run, submit and collect may submit to the queue, so nothing else may use it during
/// these calls. What they wait for is the fence of their own work.
///
/// Nothing needs to be enabled on the device: the base is Vulkan 1.1 without features and without
/// extensions. The queue family must have VK_QUEUE_GRAPHICS_BIT and VK_QUEUE_COMPUTE_BIT.
struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;               ///< made for Vulkan 1.1 or later
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;  ///< what `device` was made from
    VkDevice device = VK_NULL_HANDLE;                   ///< all objects are made on it
    VkQueue queue = VK_NULL_HANDLE;                     ///< all work is submitted to it
    std::uint32_t queue_family = 0;                     ///< of `queue`
    /// Every entry point is fetched through this one.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    /// The instance was created with VK_EXT_debug_utils: objects are named, passes are labelled.
    bool debug_utils = false;
    /// The device was created with the feature logicOp enabled: IntersectionStrategy::logic_op may
    /// be used. What the physical device could do says nothing about the device, so the host does.
    bool logic_op = false;
};

/// Which device a headless context takes.
struct HeadlessOptions {
    /// A part of the device's name, case-sensitive; empty: the best kind there is (discrete,
    /// integrated, virtual, then a CPU implementation such as lavapipe).
    const char* device_name = nullptr;
};

}  // namespace nearfield
