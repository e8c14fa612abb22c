#pragma once

#include <nearfield/vulkan.hpp>

#include <cstdint>

namespace nearfield::test {

/// The physical device, as a host inspects it before it creates a device.
[[nodiscard]] PhysicalDevice physical_device_of(const HostDevice& host);

/// True if the device has the optional part with that name (Requirements::optional).
[[nodiscard]] bool offers(const HostDevice& host, const char* part);

/// VkPhysicalDeviceLimits::subPixelPrecisionBits: 4, the minimum that Vulkan requires, or more.
[[nodiscard]] std::uint32_t sub_pixel_bits(const HostDevice& host);

/// True if the CPU's intersections have the samples that the device draws.
[[nodiscard]] bool has_grid_of_cpu(const HostDevice& host);

/// Expects the error of a query whose strategy needs the feature logicOp on a device without it.
void expect_logic_op_refused(const IntersectionResult& result);

}  // namespace nearfield::test
