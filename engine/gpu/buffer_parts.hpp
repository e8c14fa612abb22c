#pragma once

#include <engine/gpu/device.hpp>

#include <cstdint>
#include <vector>

namespace nearfield {

/// Minimum size in bytes of a bound part of a buffer, the last part included: Vulkan forbids an
/// empty range.
inline constexpr std::uint64_t smallest_part = 16;

template <class Element>
[[nodiscard]] std::uint64_t bytes_of(const std::vector<Element>& elements) {
    return elements.size() * sizeof(Element);
}

/// Throws StatusException (too_large) if `bytes` exceed what the device's storage buffers can hold.
/// `what`: the contents, in the plural, for the message.
void require_range(const gpu::Device& device, std::uint64_t bytes, const char* what);

}  // namespace nearfield
