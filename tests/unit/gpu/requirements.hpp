#pragma once

#include <nearfield/requirements.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>

namespace nearfield::test_support {

/// The physical device, as a host inspects it before it creates a device.
inline PhysicalDevice physical(const HostDevice& host) {
    PhysicalDevice device;
    device.queue_family = host.queue_family;
    device.instance = host.instance;
    device.physical_device = host.physical_device;
    device.get_instance_proc_addr = host.get_instance_proc_addr;
    device.debug_utils = host.debug_utils;
    return device;
}

/// Its requirements; the query must not fail.
inline Requirements requirements_of(const PhysicalDevice& device) {
    const Expected<Requirements> found = requirements(device);
    EXPECT_TRUE(found.has_value()) << found.error().text();
    return found.has_value() ? *found : Requirements{};
}

inline Requirements requirements_of(const HostDevice& host) {
    return requirements_of(physical(host));
}

/// A driver whose format lacks some features.
inline Lies without(VkFormat format, VkFormatFeatureFlags features) {
    Lies lies;
    lies.format = [=](VkFormat asked, VkFormatProperties& properties) {
        if (asked == format) {
            properties.optimalTilingFeatures &= ~features;
        }
    };
    return lies;
}

/// True if a format can be blended, according to the driver itself.
inline bool blends(const HostDevice& host, VkFormat format) {
    VkFormatProperties properties{};
    reinterpret_cast<PFN_vkGetPhysicalDeviceFormatProperties>(
        host.get_instance_proc_addr(host.instance, "vkGetPhysicalDeviceFormatProperties"))(
        host.physical_device, format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
}

}  // namespace nearfield::test_support
