#pragma once

#include <nearfield/shape.hpp>

#include <span>

namespace nearfield::tools {

/// A shape at a place, as far as a tolerance depends on it.
struct PlacedRings {
    std::span<const Ring> rings;
    double deviation = 0.0;
    Vector2 translation;
};

/// The tolerance of a separation or a closest point that states none: its answer is exact, and only
/// what it says of the grid depends on the tolerance. A thousandth of the longest side of the
/// boxes of both shapes, or more where their deviations or the size of their coordinates ask for
/// it.
[[nodiscard]] double usual_tolerance(const PlacedRings& a, const PlacedRings& b);

}  // namespace nearfield::tools
