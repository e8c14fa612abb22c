#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::test {

/// A NumPy array of little-endian float32 in two dimensions.
struct FloatArray {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> values;
};

/// Reads NPY format 1.0 strictly; throws where the bytes are anything but a FloatArray.
[[nodiscard]] FloatArray parse_npy(const std::string& bytes);

/// What the header of a PNG says.
struct PngSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Throws where signature, header or end of a PNG are not in place.
[[nodiscard]] PngSize parse_png(const std::string& bytes);

}  // namespace nearfield::test
