#pragma once

#include <nearfield/nearfield.hpp>

#include <cstdint>

namespace nearfield::test {

/// The device as a host asks about it before it makes one.
[[nodiscard]] PhysicalDevice physical_device_of(const HostDevice& host);

/// Whether the device has the optional part of that name (Requirements::optional).
[[nodiscard]] bool offers(const HostDevice& host, const char* part);

/// VkPhysicalDeviceLimits::subPixelPrecisionBits: 4, the fewest that a device may have, or more.
[[nodiscard]] std::uint32_t sub_pixel_bits(const HostDevice& host);

/// What a query has to say whose strategy needs the feature logicOp, of a device that has it not.
void expect_logic_op_refused(const IntersectionResult& result);

}  // namespace nearfield::test
