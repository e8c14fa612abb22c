#pragma once

#include <tests/oracle/shape_oracle.hpp>

#include <optional>
#include <span>

/// \file
/// Areas and predicates of whole shapes, by GEOS.

namespace nearfield::oracle {

/// What two shapes have in common.
struct Overlap {
    double area = 0.0;
    Rectangle box;  ///< around it; meaningful where the area is positive
};

/// Area of a shape by the odd-even rule, exact to rounding.
[[nodiscard]] double area(const ShapeOracle& shape);

/// The overlap of the interiors, exact to rounding.
[[nodiscard]] Overlap overlap(const ShapeOracle& a, const ShapeOracle& b);

/// True where the closed shapes share a point: boundaries meet (all edges count, lines of no width
/// too), or one shape holds a ring of the other.
[[nodiscard]] bool intersects(const ShapeOracle& a, const ShapeOracle& b);

/// The least distance between the two boundaries.
[[nodiscard]] double boundary_distance(const ShapeOracle& a, const ShapeOracle& b);

/// A pose of B, turned by `angle` and moved along `direction` (not zero) from where the two shapes
/// have their middles in one place, at which the overlap is `share` (between 0 and 1) of the
/// smaller area, to 1e-6 of it. None where they overlap by less with their middles in one place.
[[nodiscard]] std::optional<Pose> pose_for_overlap(const ShapeOracle& a, std::span<const Ring> b,
                                                   double angle, const Vector2& direction,
                                                   double share);

}  // namespace nearfield::oracle
