#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/exact/placed_edges.hpp>

namespace nearfield::exact {

/// What Boundary says of a point, from all of a small shape's edges.
[[nodiscard]] NearestPoint nearest(const PlacedEdges& edges, const geometry::Vector& point);

/// The same as Boundary::is_unique among at most most_edges_one_by_one edges, which leave out none
/// that is nearer than the nearest and `margin`.
[[nodiscard]] bool is_unique(const EdgeArrays& edges, const geometry::Vector& point,
                             const NearestPoint& nearest, double margin);

}  // namespace nearfield::exact
