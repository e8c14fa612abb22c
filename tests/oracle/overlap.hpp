#pragma once

#include <tests/oracle/shape_oracle.hpp>

#include <optional>
#include <span>

/// \file Areas and predicates of whole shapes, computed by GEOS.

namespace nearfield::oracle {

/// The intersection of two shapes.
struct Overlap {
    double area = 0.0;
    Rectangle box;  ///< its bounding box; meaningful if the area is positive
};

/// Area of a shape by the odd-even rule, exact to rounding.
[[nodiscard]] double area(const ShapeOracle& shape);

/// The intersection of the interiors, exact to rounding.
[[nodiscard]] Overlap overlap(const ShapeOracle& a, const ShapeOracle& b);

/// True if the closed shapes share a point: boundaries intersect (all edges count, zero-width lines
/// too), or one shape contains a ring of the other.
[[nodiscard]] bool intersects(const ShapeOracle& a, const ShapeOracle& b);

/// How far A reaches out of B: 0 if every point of the closed shape A is a point of the closed
/// shape B, and otherwise the distance from B of a point of A outside B: not always the farthest,
/// but one in the middle of a part of A that is outside.
[[nodiscard]] double protrusion(const ShapeOracle& a, const ShapeOracle& b);

/// The minimum distance between the two boundaries.
[[nodiscard]] double boundary_distance(const ShapeOracle& a, const ShapeOracle& b);

/// A pose of B, turned by `angle` and moved along `direction` (not zero) from coinciding centres,
/// at which the overlap is `share` (between 0 and 1) of the smaller area, to 1e-6 of it. Empty if
/// the overlap is smaller even with coinciding centres.
[[nodiscard]] std::optional<Pose> pose_for_overlap(const ShapeOracle& a, std::span<const Ring> b,
                                                   double angle, const Vector2& direction,
                                                   double share);

}  // namespace nearfield::oracle
