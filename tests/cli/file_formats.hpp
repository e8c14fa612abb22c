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

/// Parses NPY format 1.0 strictly; throws unless the bytes are a FloatArray.
[[nodiscard]] FloatArray parse_npy(const std::string& bytes);

/// The size in the header of a PNG file.
struct PngSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Throws if the signature, header or end of a PNG file is missing.
[[nodiscard]] PngSize parse_png(const std::string& bytes);

}  // namespace nearfield::test
