#pragma once

#include <engine/geometry/transformed_polygon.hpp>

#include <span>

namespace nearfield::localize {

/// A box in world coordinates, aligned with the principal axes of its contents.
struct OrientedBox {
    geometry::Vector centre = geometry::Vector::Zero();
    geometry::Vector axis = geometry::Vector::UnitX();  ///< unit: the direction of `half.x()`
    geometry::Vector half = geometry::Vector::Zero();   ///< half the side lengths
};

/// Returns the box around vertices of a transformed polygon, given relative to its centre in two
/// runs (a chain may wrap around its ring's end). The box is larger by `rounding` on every side,
/// which covers the rounding of the transform and of box comparisons.
[[nodiscard]] OrientedBox oriented_box(const geometry::TransformedPolygon& placed,
                                       std::span<const geometry::Vector> run,
                                       std::span<const geometry::Vector> wrapped, double rounding);

/// Returns a lower bound on the distance of two boxes: the widest gap between them along an axis of
/// either; negative if there is none.
[[nodiscard]] double gap(const OrientedBox& a, const OrientedBox& b);

}  // namespace nearfield::localize
