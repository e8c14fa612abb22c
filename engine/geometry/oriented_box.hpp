#pragma once

#include <engine/geometry/transformed_polygon.hpp>

#include <span>

namespace nearfield::geometry {

/// A box in world coordinates, aligned with the principal axes of its contents.
struct OrientedBox {
    Vector centre = Vector::Zero();
    Vector axis = Vector::UnitX();  ///< unit: the direction of `half.x()`
    Vector half = Vector::Zero();   ///< half the side lengths
};

/// Returns the box around vertices of a transformed polygon, given relative to its centre in two
/// runs (a chain may wrap around its ring's end). The box is larger by `rounding` on every side,
/// which covers the rounding of the transform and of box comparisons.
[[nodiscard]] OrientedBox oriented_box(const TransformedPolygon& placed,
                                       std::span<const Vector> run, std::span<const Vector> wrapped,
                                       double rounding);

/// Returns a lower bound on the distance of two boxes: the widest gap between them along an axis of
/// either; negative if there is none.
[[nodiscard]] double gap(const OrientedBox& a, const OrientedBox& b);

}  // namespace nearfield::geometry
