#pragma once

#include <nearfield/shape.hpp>

#include <span>

namespace nearfield::simulation {

/// The mass properties of a plate of density 1.
struct MassProperties {
    double area = 0.0;
    Vector2 centroid;
    double inertia = 0.0;  ///< about the centroid and the axis normal to the plane
};

/// The properties of the shape that rings fill by the odd-even rule: non-convex outlines, holes,
/// islands in holes and separate parts, in any order and orientation. Precondition: no ring crosses
/// itself or another.
[[nodiscard]] MassProperties mass_properties(std::span<const Ring> rings);

}  // namespace nearfield::simulation
