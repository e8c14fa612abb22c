#pragma once

#include "examples/common/picture.hpp"

#include <filesystem>
#include <vector>

namespace nearfield::test {

/// The pixels of a PNG file.
struct Pixels {
    int width = 0;
    int height = 0;
    std::vector<examples::Color> colors;  ///< row by row from the top; opaque

    [[nodiscard]] const examples::Color& at(int x, int y) const {
        return colors[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

/// Throws std::runtime_error if there is no such picture.
[[nodiscard]] Pixels read_picture(const std::filesystem::path& file);

}  // namespace nearfield::test
