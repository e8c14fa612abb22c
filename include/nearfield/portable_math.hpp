#pragma once

#include <nearfield/export.hpp>

/// \file
/// Trigonometry whose results have the same bits on every machine. Those of std::sin and the like
/// depend on the C library and on the processor. The library uses these functions for all its
/// answers; a host whose own motion must not depend on the machine can use them too.

namespace nearfield {

/// Sine and cosine of an angle.
struct SineCosine {
    double sine = 0.0;    ///< of the angle
    double cosine = 1.0;  ///< of the angle
};

/// The sine and cosine of an angle in radians, of any size; each off by less than 0.9 units in the
/// last place. NaN for an angle that is not finite. Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT SineCosine sine_cosine(double angle) noexcept;

/// The angle in radians, from -pi to pi, of the vector (x, y) from the x axis; off by less than 4
/// units in the last place. 0 for the vector (0, 0), NaN if a coordinate is not finite.
/// Thread-safe.
[[nodiscard]] NEARFIELD_EXPORT double arc_tangent(double y, double x) noexcept;

}  // namespace nearfield
