#pragma once

#include <engine/geometry/vector.hpp>

namespace nearfield::geometry {

/// Returns the point on the line through a and b whose coordinate `axis` (0: x, 1: y) is exactly
/// `value`. Precondition: the two points differ in that coordinate.
[[nodiscard]] Vector point_on_line(const Vector& a, const Vector& b, int axis, double value);

/// Clips the segment ab to the slab low <= coordinate `axis` <= high. An end inside the slab keeps
/// its exact value. Returns false, and leaves both ends unchanged, if no point of ab is in the
/// slab.
[[nodiscard]] bool clip_to_slab(Vector& a, Vector& b, int axis, double low, double high);

}  // namespace nearfield::geometry
