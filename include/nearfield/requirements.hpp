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
/// The requirements on a Vulkan device, queried before the device is created.

namespace nearfield {

/// A physical device, and what its host has decided about the device that it will create.
struct PhysicalDevice {
    /// The queue family that the host will use; any_queue_family: requirements() selects one.
    std::uint32_t queue_family = any_queue_family;
    VkInstance instance = VK_NULL_HANDLE;               ///< borrowed for the call
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;  ///< of that instance
    /// Every entry point is loaded through this function.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    /// VkApplicationInfo::apiVersion of the instance; 0: Vulkan 1.1 or later. Whatever the device
    /// offers beyond this version is not used.
    std::uint32_t api_version = 0;
    /// VK_EXT_debug_utils is enabled on the instance.
    bool debug_utils = false;

    /// No particular family.
    static constexpr std::uint32_t any_queue_family = UINT32_MAX;
};

/// A limit that the base requires. All are minima guaranteed by the specification.
struct RequiredLimit {
    const char* name = "";      ///< as in VkPhysicalDeviceLimits
    std::uint32_t needed = 0;   ///< minimum
    std::uint32_t offered = 0;  ///< by the device
    const char* why = "";       ///< the purpose
};

/// A format that the base requires, with optimal tiling. Some formats are alternatives: they are
/// adjacent in the list, the preferred one first, and one of them is enough.
struct RequiredFormat {
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< the format
    const char* name = "";                  ///< its name, as in VkFormat
    VkFormatFeatureFlags needed = 0;        ///< with optimal tiling
    VkFormatFeatureFlags offered = 0;       ///< by the device
    const char* why = "";                   ///< the purpose
    /// The next format in the list is an alternative.
    bool or_next = false;
};

/// An optional feature or extension that a host may enable or a device may have.
struct OptionalPart {
    const char* name = "";     ///< "logicOp", "VK_EXT_debug_utils", ...
    const char* unlocks = "";  ///< the function that it makes available
    bool available = false;    ///< the device has it and the host may enable it
    /// The reasons if it is not available; empty otherwise.
    std::vector<std::string> missing;
};

/// The requirements of nearfield on a device, and the optional parts that it can use; see
/// requirements().
struct Requirements {
    /// Every base requirement that is not met, one text each. Empty: Context::create() accepts a
    /// device created without any feature or extension.
    std::vector<std::string> unmet;

    std::uint32_t api_version = VK_API_VERSION_1_1;   ///< minimum
    VkQueueFlags queue_flags = VK_QUEUE_COMPUTE_BIT;  ///< of one family
    /// The queue family to use: the one given, or the first that also draws, or the first that
    /// suffices.
    std::optional<std::uint32_t> queue_family;
    std::vector<RequiredLimit> limits;    ///< required and offered limits
    std::vector<RequiredFormat> formats;  ///< required and offered formats

    /// The optional parts: Technique::raster, each intersection strategy outside the base, precise
    /// blended gradients, timeline semaphores, pass times, names and labels.
    std::vector<OptionalPart> optional;
    /// The optional features that the device offers, for VkDeviceCreateInfo; everything else is
    /// off. A host that enables them sets HostDevice::logic_op to features.logicOp.
    VkPhysicalDeviceFeatures features{};
    /// The feature timelineSemaphore, if the device offers it, for HostDevice::timeline_semaphore.
    /// pNext is null.
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline_semaphore{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES, nullptr, VK_FALSE};
    /// The device extensions that these features need; none from Vulkan 1.2 on.
    std::vector<const char*> device_extensions;
    /// Extensions for the instance, if it offers them (HostDevice::debug_utils).
    std::vector<const char*> instance_extensions;

    /// True if `unmet` is empty.
    [[nodiscard]] bool met() const noexcept { return unmet.empty(); }
    /// The optional part of that name, or null. Valid as long as `optional` is unchanged.
    [[nodiscard]] NEARFIELD_EXPORT const OptionalPart* find(const char* name) const noexcept;
};

/// Checks a physical device against the requirements of nearfield. Creates and changes nothing;
/// queries the driver for properties, limits, formats, queue families, features and extensions. An
/// unmet requirement is not an error. Fails with invalid_settings for a null handle or an
/// api_version that is not a version of Vulkan 1; with out_of_memory. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT Expected<Requirements> requirements(const PhysicalDevice& device);

}  // namespace nearfield
