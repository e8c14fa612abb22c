#pragma once

#include <cmath>
#include <cstdint>

namespace nearfield::geometry {

/// std::floor and std::ceil inline: compiled for a generic machine they are calls, which would
/// dominate snapping.
[[nodiscard]] inline double whole_below(double value) {
    // Numbers this large are integers, and NaN stays NaN.
    if (!(std::abs(value) < 0x1p52)) {
        return value;
    }
    const auto whole = static_cast<double>(static_cast<std::int64_t>(value));
    return whole > value ? whole - 1.0 : whole;
}
[[nodiscard]] inline double whole_above(double value) {
    return -whole_below(-value);
}

}  // namespace nearfield::geometry
