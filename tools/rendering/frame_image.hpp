#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A picture in memory: 0xAARRGGBB with alpha 255, row by row from the top.
struct FrameImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint32_t> pixels;
};

/// Encodes an image as a PNG file.
[[nodiscard]] std::string png_of(const FrameImage& image);

}  // namespace nearfield::tools
