#pragma once

#include <cstdint>
#include <ostream>
#include <span>

namespace nearfield::tools {

/// Writes a two-dimensional array of float32 in NumPy's format (version 1.0, little endian, C
/// order): shape (height, width), row 0 first. Precondition: width * height values.
void write_npy(std::ostream& stream, std::span<const float> values, std::uint32_t width,
               std::uint32_t height);

}  // namespace nearfield::tools
