#pragma once

#include <nearfield/export.hpp>
#include <nearfield/query.hpp>
#include <nearfield/status.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// \file
/// What nearfield needs of a device, asked before there is one.

namespace nearfield {

/// A physical device, and what its host has settled already about the device it will make of it.
/// For `structure_size` see host.hpp.
struct PhysicalDevice {
    std::uint32_t structure_size = sizeof(PhysicalDevice);  ///< leave it as it is
    /// The family that the host will give a queue of; any_queue_family: it wants one named.
    std::uint32_t queue_family = any_queue_family;
    VkInstance instance = VK_NULL_HANDLE;               ///< borrowed for the call
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;  ///< of that instance
    /// Every entry point is fetched through this one.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    /// VkApplicationInfo::apiVersion of the instance; 0: Vulkan 1.1 or later. What the device
    /// offers beyond it may not be used.
    std::uint32_t api_version = 0;
    /// The instance was created with VK_EXT_debug_utils.
    bool debug_utils = false;

    /// No family in particular.
    static constexpr std::uint32_t any_queue_family = UINT32_MAX;
};

/// A limit that the base needs. All are minima of the specification.
struct RequiredLimit {
    const char* name = "";      ///< as in VkPhysicalDeviceLimits
    std::uint32_t needed = 0;   ///< at least
    std::uint32_t offered = 0;  ///< by the device
    const char* why = "";       ///< what it is needed for
};

/// A format that the base needs, with optimal tiling. One of several may be enough: a group of
/// alternatives stands together, the better one first.
struct RequiredFormat {
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< what is needed for `why`
    const char* name = "";                  ///< of the format, as in VkFormat
    VkFormatFeatureFlags needed = 0;        ///< of optimal tiling
    VkFormatFeatureFlags offered = 0;       ///< by the device
    const char* why = "";                   ///< what it is needed for
    /// The next one in the list will do as well.
    bool or_next = false;
};

/// Something that a host may enable, or that a device may have, and what it is good for.
struct OptionalPart {
    const char* name = "";     ///< "logicOp", "VK_EXT_debug_utils", ...
    const char* unlocks = "";  ///< what it is good for
    bool available = false;    ///< the device has it, and the host may enable it
    /// Why not; empty where it is available.
    std::vector<std::string> missing;
};

/// What nearfield needs of a device and what more it can use; see requirements().
struct Requirements {
    /// Everything that the base needs and that is not there, one text each. Empty: a device can be
    /// made, with no feature and no extension, and Context::create() will take it.
    std::vector<std::string> unmet;

    std::uint32_t api_version = VK_API_VERSION_1_1;                           ///< needed
    VkQueueFlags queue_flags = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;  ///< of one family
    /// The family to take a queue of: the one asked about, or the first that suffices.
    std::optional<std::uint32_t> queue_family;
    std::vector<RequiredLimit> limits;    ///< needed, with what there is
    std::vector<RequiredFormat> formats;  ///< needed, with what there is

    /// What is not needed: each strategy of intersections that does not belong to the base, precise
    /// blended gradients, timeline semaphores, times of passes, names and labels.
    std::vector<OptionalPart> optional;
    /// The features among them that the device offers: for VkDeviceCreateInfo, and then
    /// HostDevice::logic_op is features.logicOp. Everything else is off.
    VkPhysicalDeviceFeatures features{};
    /// timelineSemaphore likewise, and HostDevice::timeline_semaphore. pNext is null.
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline_semaphore{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES, nullptr, VK_FALSE};
    /// The device extensions that these features take; none from Vulkan 1.2 on.
    std::vector<const char*> device_extensions;
    /// For the instance, if it offers them (HostDevice::debug_utils).
    std::vector<const char*> instance_extensions;

    /// True where nothing is unmet.
    [[nodiscard]] bool met() const noexcept { return unmet.empty(); }
    /// The optional part of that name, or null.
    [[nodiscard]] NEARFIELD_EXPORT const OptionalPart* find(const char* name) const noexcept;
};

/// What nearfield needs of this physical device. Creates nothing and changes nothing; asks the
/// driver for properties, limits, formats, queue families, features and extensions. What a device
/// lacks is no error. Fails where there is nothing to ask (invalid_settings): a null handle, an
/// api_version that is none of Vulkan 1, or a structure_size that never was one. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Expected<Requirements> requirements(const PhysicalDevice& device);

}  // namespace nearfield
