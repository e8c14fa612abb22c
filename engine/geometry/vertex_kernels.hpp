#pragma once

#include <engine/geometry/vector.hpp>

#include <cstdint>
#include <span>

/// \file
/// The loops over all vertices of a shape that every frame runs, vectorised: compiled for each
/// instruction set that the compiler supports and selected at run time for the machine. Results are
/// bit-identical on all of them: no product is fused with a sum.

namespace nearfield::geometry {

/// A box as plain numbers.
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

/// A rotation, then a translation: x maps to `x_axis`, y to `y_axis`.
struct Placement {
    double x_axis[2];
    double y_axis[2];
    double translation[2];
};

namespace kernels {

/// Transforms vertices, writes exactly as many coordinates, and returns their bounding box.
/// Precondition: at least one vertex.
[[nodiscard]] Extent place_points(std::span<const Vector> vertices, const Placement& placement,
                                  double* x, double* y);

/// Returns the bounding box of the same points, bit for bit.
[[nodiscard]] Extent find_extent(std::span<const Vector> vertices, const Placement& placement);

/// Properties of a ring's vertices that are checked before they are used.
struct VertexRange {
    Extent box;
    bool finite = true;   ///< no coordinate is infinite or NaN; if false, the box is meaningless
    double length = 0.0;  ///< the sum of |dx| + |dy|: an upper bound on the ring's length
};

/// Precondition: at least one vertex.
[[nodiscard]] VertexRange find_range(std::span<const Vector2> vertices);

/// Writes vertices relative to a centre.
void subtract(std::span<const Vector2> vertices, const Vector& centre, Vector* relative);

}  // namespace kernels

}  // namespace nearfield::geometry
