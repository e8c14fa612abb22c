#pragma once

#include <engine/exact/placed_edges.hpp>
#include <engine/exact/work_meter.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::exact {

/// How deep a point lies inside edges by the odd-even rule: the distance to the nearest, negative
/// outside.
[[nodiscard]] double depth_in(const PlacedEdges& edges, const geometry::Vector& point);

/// What tells how deep a shape is in another one.
///
/// A disc that lies in the shape: its radius and the depth of its centre in the other shape are
/// together no more than how far the shape can be moved, whichever way, without being apart from
/// the other. A vertex is one of no radius. And a group of vertices around a centre, each of them
/// no more or less deep than the centre by how far they are from it.
struct Witness {
    geometry::Vector centre;
    double radius = 0.0;      ///< of the disc
    double spread = 0.0;      ///< no vertex of the group is farther from the centre
    std::uint32_t first = 0;  ///< of a group: its first part, in the array of all witnesses
    std::uint32_t parts = 0;  ///< how many follow each other there
    bool is_vertex = false;
};

/// Appends discs that touch the middle of some edges and are as large as fit in, all vertices, and
/// groups of eight that follow each other, of eight groups, and so on. Lists in `top` the discs,
/// the largest first, and the groups that all vertices are in.
void add_witnesses(const PlacedEdges& edges, WorkMeter& work, std::vector<Witness>& witnesses,
                   std::vector<std::uint32_t>& top);

}  // namespace nearfield::exact
