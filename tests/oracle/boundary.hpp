#pragma once

#include <tests/oracle/shape_oracle.hpp>

#include <cstddef>
#include <vector>

/// \file Queries on whole boundaries.

namespace nearfield::oracle {

/// The maximum depth of a boundary in a shape.
struct Deepest {
    Vector2 point;       ///< on the boundary
    double depth = 0.0;  ///< its depth, negative if it is outside
    double upper = 0.0;  ///< no point of the boundary is deeper
};

/// The deepest point of A's boundary inside B to within `accuracy`, by branch and bound: depth
/// changes by at most one unit per unit along the boundary. If all of A's boundary is outside B,
/// `depth` is negative and `upper` is at most `accuracy`.
[[nodiscard]] Deepest deepest_on_boundary(const ShapeOracle& a, const ShapeOracle& b,
                                          double accuracy);

/// The deepest vertex of A inside B; `upper` equals `depth`.
[[nodiscard]] Deepest deepest_vertex(const ShapeOracle& a, const ShapeOracle& b);

/// Points along the boundary including all vertices; consecutive points are at most `spacing`
/// apart, or farther if there would be more than `most` points otherwise, not counting vertices.
[[nodiscard]] std::vector<Vector2> sample_boundary(const ShapeOracle& shape, double spacing,
                                                   std::size_t most);

/// Points where edges of A properly cross edges of B, at most `most`.
[[nodiscard]] std::vector<Vector2> crossings(const ShapeOracle& a, const ShapeOracle& b,
                                             std::size_t most);

}  // namespace nearfield::oracle
