#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <vector>

namespace nearfield::peers {

/// Convex polygons of at most `max_vertices` that together fill a ring: its triangles, joined as
/// far as they remain convex; all counter-clockwise. Throws std::runtime_error if the ring crosses
/// itself. Precondition: max_vertices >= 3.
[[nodiscard]] std::vector<Ring> convex_pieces(const Ring& ring, std::size_t max_vertices);

}  // namespace nearfield::peers
