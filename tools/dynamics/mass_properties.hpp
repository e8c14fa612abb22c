#pragma once

#include <nearfield/shape.hpp>

#include <span>

namespace nearfield::dynamics {

/// What a plate of density 1 resists motion with.
struct MassProperties {
    double area = 0.0;
    Vector2 centroid;
    double inertia = 0.0;  ///< moment about the centroid, out of the plane
};

/// Of the shape that rings fill by the odd-even rule: non-convex outlines, holes, parts in holes
/// and separate parts, in any order and orientation. Precondition: no ring crosses itself or
/// another.
[[nodiscard]] MassProperties mass_properties(std::span<const Ring> rings);

}  // namespace nearfield::dynamics
