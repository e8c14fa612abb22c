#pragma once

#include <engine/geometry/vector.hpp>

namespace nearfield::geometry {

/// The point of the line through a and b whose coordinate `axis` (0: x, 1: y) is `value`, exactly.
/// The two points must differ in that coordinate.
[[nodiscard]] Vector point_on_line(const Vector& a, const Vector& b, int axis, double value);

/// Cuts the segment ab to the slab low <= coordinate `axis` <= high. An end inside the slab stays
/// exactly what it was. False, and both ends as they were, where no point of ab is in the slab.
[[nodiscard]] bool clip_to_slab(Vector& a, Vector& b, int axis, double low, double high);

}  // namespace nearfield::geometry
