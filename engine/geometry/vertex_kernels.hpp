#pragma once

#include <engine/geometry/vector.hpp>

#include <cstdint>
#include <span>

/// \file
/// The loops over all vertices of a shape that every frame has to go through, several at once:
/// compiled for every instruction set that the compiler knows, chosen at run time for the machine.
/// Every one rounds the same on all of them: no product is fused with a sum.

namespace nearfield::geometry {

/// A box without any class around it.
struct Extent {
    double low_x = 0.0;
    double low_y = 0.0;
    double high_x = 0.0;
    double high_y = 0.0;
};

[[nodiscard]] inline Extent extent_of(const Box& box) {
    return {box.min().x(), box.min().y(), box.max().x(), box.max().y()};
}
[[nodiscard]] inline Box box_of(const Extent& extent) {
    return {Vector(extent.low_x, extent.low_y), Vector(extent.high_x, extent.high_y)};
}

/// A rotation, then a translation: x is turned to `x_axis`, y to `y_axis`.
struct Placement {
    double x_axis[2];
    double y_axis[2];
    double translation[2];
};

namespace kernels {

/// Places vertices and returns the box around them. At least one vertex; writes no more than there
/// are.
[[nodiscard]] Extent place_points(std::span<const Vector> vertices, const Placement& placement,
                                  double* x, double* y);

/// The box around the same points, bit for bit.
[[nodiscard]] Extent find_extent(std::span<const Vector> vertices, const Placement& placement);

/// What there is to know of a ring's vertices before they are used.
struct VertexRange {
    Extent box;
    bool finite = true;   ///< no coordinate is infinite or no number; if not, the box says nothing
    double length = 0.0;  ///< of the ring, along both axes together: no less than its length
};

/// At least one vertex.
[[nodiscard]] VertexRange find_range(std::span<const Vector2> vertices);

/// Writes vertices relative to a centre.
void subtract(std::span<const Vector2> vertices, const Vector& centre, Vector* relative);

}  // namespace kernels

}  // namespace nearfield::geometry
