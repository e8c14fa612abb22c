#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::geometry {

/// A straight edge that replaces a run of consecutive edges of one ring. The simplified edges of a
/// ring, in order, form a closed ring again.
struct SimplifiedEdge {
    std::uint32_t first = 0;  ///< vertex where the run starts
    std::uint32_t last = 0;   ///< vertex where it ends
    std::uint32_t count = 1;  ///< edges in the run; 1: an original edge, with deviation 0
    /// No point of the run is farther from the straight edge than this, nor the other way round.
    double deviation = 0.0;
};

/// Replaces chains of short edges by straight ones that stay within `deviation` of them in both
/// directions, in one pass over the vertices. No vertex of a run is farther from its first than
/// `longest_run`, and a ring keeps at least two simplified edges. Original edges longer than
/// `longest_run` are kept. Appends to `edges`, ring after ring.
void simplify(const Polygon& polygon, double deviation, double longest_run,
              std::vector<SimplifiedEdge>& edges);

/// Number of edges per block of a ring in simplify_near().
inline constexpr std::uint32_t edges_of_a_block = 64;

/// Simplifies for a caller that reads only a window of the world. No run crosses from one block of
/// its ring to the next, so each block is simplified independently, with the same result for any
/// window. A block whose vertices' box does not intersect the window becomes a single edge of
/// infinite deviation, which stays in that box; a ring may be left with one edge.
void simplify_near(const TransformedPolygon& placed, const Box& window, double deviation,
                   double longest_run, std::vector<SimplifiedEdge>& edges);

}  // namespace nearfield::geometry
