#pragma once

#include <tests/oracle/shape_oracle.hpp>

#include <cstddef>
#include <vector>

/// \file
/// Questions about whole boundaries.

namespace nearfield::oracle {

/// How deep a boundary reaches into a shape.
struct Deepest {
    Vector2 point;       ///< of the boundary
    double depth = 0.0;  ///< its depth, negative where it is outside
    double upper = 0.0;  ///< no point of the boundary is deeper
};

/// The deepest point of A's boundary inside B to within `accuracy`, by branch and bound: depth
/// changes no faster than one unit a unit along the boundary. Where all of A's boundary is outside
/// B, `depth` is negative and `upper` at most `accuracy`.
[[nodiscard]] Deepest deepest_on_boundary(const ShapeOracle& a, const ShapeOracle& b,
                                          double accuracy);

/// The deepest vertex of A inside B; `upper` equals `depth`.
[[nodiscard]] Deepest deepest_vertex(const ShapeOracle& a, const ShapeOracle& b);

/// Points along the boundary, all vertices among them, consecutive ones at most `spacing` apart
/// (wider where there would be more than `most` otherwise, vertices not counted).
[[nodiscard]] std::vector<Vector2> sample_boundary(const ShapeOracle& shape, double spacing,
                                                   std::size_t most);

/// Where edges of A cross edges of B properly; no more than `most` points.
[[nodiscard]] std::vector<Vector2> crossings(const ShapeOracle& a, const ShapeOracle& b,
                                             std::size_t most);

}  // namespace nearfield::oracle
