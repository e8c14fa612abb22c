#pragma once

#include <engine/gpu/device.hpp>

#include <cstdint>
#include <vector>

namespace nearfield {

/// Every part of a buffer that is bound has at least these bytes, its last one too: a range of no
/// bytes is not allowed.
inline constexpr std::uint64_t smallest_part = 16;

template <class Element>
[[nodiscard]] std::uint64_t bytes_of(const std::vector<Element>& elements) {
    return elements.size() * sizeof(Element);
}

/// Throws Failure (too_large) where the device's storage buffers cannot hold so much. `what` it is
/// of one round, in the plural, for the message.
void require_range(const gpu::Device& device, std::uint64_t bytes, const char* what);

}  // namespace nearfield
