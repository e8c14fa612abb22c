#pragma once

#include <algorithm>
#include <cstdint>

namespace nearfield::geometry {

/// The place of a point of the unit square on a Morton curve through 65,536 x 65,536 cells, along
/// which neighbours are mostly near each other; the first bits are those of a coarser curve. Points
/// beyond the square count as on its border.
[[nodiscard]] inline std::uint32_t on_morton_curve(double x, double y) {
    const auto spread = [](double part) {
        auto bits = static_cast<std::uint32_t>(std::clamp(65536.0 * part, 0.0, 65535.0));
        bits = (bits | bits << 8U) & 0x00ff00ffU;
        bits = (bits | bits << 4U) & 0x0f0f0f0fU;
        bits = (bits | bits << 2U) & 0x33333333U;
        return (bits | bits << 1U) & 0x55555555U;
    };
    return spread(x) | spread(y) << 1U;
}

}  // namespace nearfield::geometry
