#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <vector>

namespace nearfield::simulation {

/// Removes vertices from a ring until `count` are left: first those whose triangle with their
/// neighbours is smallest, and none whose removal would make the ring cross itself. Precondition:
/// the ring does not cross itself and has more vertices than it needs for that; `count` >= 3.
[[nodiscard]] Ring thinned(Ring ring, std::size_t count);

/// The outlines of six countries, about the origin, each of the same area.
[[nodiscard]] std::vector<Ring> countries(double area);

}  // namespace nearfield::simulation
