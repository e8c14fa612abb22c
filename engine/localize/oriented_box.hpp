#pragma once

#include <engine/geometry/placed_polygon.hpp>

#include <span>

namespace nearfield::localize {

/// A box along the principal axes of what it holds, in the world.
struct OrientedBox {
    geometry::Vector centre = geometry::Vector::Zero();
    geometry::Vector axis = geometry::Vector::UnitX();  ///< unit: the direction of `half.x()`
    geometry::Vector half = geometry::Vector::Zero();   ///< half its sides
};

/// The box around vertices of a placed polygon, given relative to its centre in two runs (a chain
/// may wrap around its ring's end). Larger by `rounding` on every side: as much as placing the
/// vertices and comparing the boxes may round.
[[nodiscard]] OrientedBox oriented_box(const geometry::PlacedPolygon& placed,
                                       std::span<const geometry::Vector> run,
                                       std::span<const geometry::Vector> wrapped, double rounding);

/// How far apart two boxes are at the least: the widest gap between them along an axis of either;
/// negative where there is none.
[[nodiscard]] double gap(const OrientedBox& a, const OrientedBox& b);

}  // namespace nearfield::localize
