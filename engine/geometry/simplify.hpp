#pragma once

#include <engine/geometry/placed_polygon.hpp>
#include <engine/geometry/polygon.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::geometry {

/// A straight edge that stands for a run of consecutive edges of one ring. The simplified edges of
/// a ring, in order, close it again.
struct SimplifiedEdge {
    std::uint32_t first = 0;  ///< vertex where the run starts
    std::uint32_t last = 0;   ///< vertex where it ends
    std::uint32_t count = 1;  ///< edges in the run; 1: the edge itself, with deviation 0
    /// No point of the run is farther from the straight edge than this, and no point of the
    /// straight edge is farther from the run.
    double deviation = 0.0;
};

/// Replaces chains of short edges by straight ones that stay within `deviation` of them, in both
/// directions, in one pass over the vertices. A run is never longer (first to any vertex of it)
/// than `longest_run`, and a ring keeps at least two simplified edges. Original edges longer than
/// `longest_run` stand for themselves. Appends to `edges`, ring after ring.
void simplify(const Polygon& polygon, double deviation, double longest_run,
              std::vector<SimplifiedEdge>& edges);

/// Edges of a ring that simplify_near() takes together.
inline constexpr std::uint32_t edges_of_a_block = 64;

/// The same for one who looks at nothing but what lies in a window of the world: no run goes on
/// from one block of its ring to the next, so that each can be simplified without the rest, and
/// comes out alike whatever the window is. A block whose vertices' box does not meet the window
/// becomes one edge of infinite deviation, which stays in that box; a ring may be left with one.
void simplify_near(const PlacedPolygon& placed, const Box& window, double deviation,
                   double longest_run, std::vector<SimplifiedEdge>& edges);

}  // namespace nearfield::geometry
