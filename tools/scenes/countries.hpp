#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <vector>

namespace nearfield::scenes {

/// A ring with vertices left out until `count` are left, those first whose triangle with their
/// neighbours is the smallest, and none that would make the ring cross itself. Precondition: the
/// ring does not cross itself and has more vertices than are needed for that, `count` >= 3.
[[nodiscard]] Ring thinned(Ring ring, std::size_t count);

/// The outlines of six countries, about the origin, each of the same area.
[[nodiscard]] std::vector<Ring> countries(double area);

}  // namespace nearfield::scenes
