#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/simd/transformed_edges.hpp>

namespace nearfield::narrowphase {

/// Boundary::nearest() by brute force over all edges of a small shape.
[[nodiscard]] NearestPoint nearest(const simd::TransformedEdges& edges,
                                   const geometry::Vector& point);

/// Boundary::is_unique() among at most max_edges_one_by_one edges, which must include every edge
/// within `margin` of the nearest distance.
[[nodiscard]] bool is_unique(const simd::EdgeArrays& edges, const geometry::Vector& point,
                             const NearestPoint& nearest, double margin);

}  // namespace nearfield::narrowphase
