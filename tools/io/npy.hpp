#pragma once

#include <cstdint>
#include <ostream>
#include <span>

namespace nearfield::tools {

/// Writes an array of float32 or uint32 with the shape (height, width) in NumPy's format (version
/// 1.0, little endian, C order), row 0 first. Precondition: width * height values.
void write_npy(std::ostream& stream, std::span<const float> values, std::uint32_t width,
               std::uint32_t height);
void write_npy(std::ostream& stream, std::span<const std::uint32_t> values, std::uint32_t width,
               std::uint32_t height);

/// The same for float32 with the shape (height, width, 2). Precondition: 2 * width * height values.
void write_npy_pairs(std::ostream& stream, std::span<const float> values, std::uint32_t width,
                     std::uint32_t height);

}  // namespace nearfield::tools
