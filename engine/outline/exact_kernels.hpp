#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>

/// \file
/// Signs without rounding. Coordinates are 0 or between 2^-200 and 2^60 in magnitude, so that no
/// product underflows or overflows.

namespace nearfield::outline::exact {

/// The sign of cross(b - a, c - a): 1 if c lies to the left of the line from a to b, 0 on it.
[[nodiscard]] int orientation(const Vector2& a, const Vector2& b, const Vector2& c);

/// A coordinate of points.
enum class Axis : std::uint8_t { x, y };

/// Two segments that cross at an inner point of both: each has its ends strictly on different sides
/// of the other's line.
struct Crossing {
    Vector2 a, b;  ///< one segment
    Vector2 c, d;  ///< the other one
};

/// The sign of a coordinate of the point where two segments cross, less `value`.
[[nodiscard]] int compare_coordinate(const Crossing& crossing, Axis axis, double value);

/// A coordinate of that point, rounded by an unknown amount.
[[nodiscard]] double approximate_coordinate(const Crossing& crossing, Axis axis);

}  // namespace nearfield::outline::exact
