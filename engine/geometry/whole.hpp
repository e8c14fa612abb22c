#pragma once

#include <cmath>
#include <cstdint>

namespace nearfield::geometry {

/// std::floor and std::ceil in line: compiled for any machine they are calls, which would take
/// most of the time where coordinates are snapped.
[[nodiscard]] inline double whole_below(double value) {
    // Numbers as large as this are whole, and what is no number stays none.
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
