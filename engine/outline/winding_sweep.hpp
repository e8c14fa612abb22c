#pragma once

#include <engine/outline/snap_rounding.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::outline {

/// An edge of a planar subdivision between the centres of two cells.
struct PlanarEdge {
    std::uint32_t low = 0;   ///< index of the lesser cell
    std::uint32_t high = 0;  ///< index of the greater cell, > low
    /// How much larger the winding number is to the left of the edge, from low to high, than to
    /// its right: how many times more rings run from low to high than back.
    std::int32_t weight = 0;

    /// True if both lie between the same cells.
    [[nodiscard]] bool coincides(const PlanarEdge& other) const {
        return low == other.low && high == other.high;
    }
};

/// Sorts edges by their cells, merges those that coincide and drops those without weight.
void merge_edges(std::vector<PlanarEdge>& edges);

/// The winding number to the right of each edge; to the left it is larger by the weight. `cells`
/// are sorted; `edges` are merged, lie between cells of it, and share nothing but ends. Exact.
[[nodiscard]] std::vector<std::int32_t> windings_to_the_right(std::span<const Cell> cells,
                                                              std::span<const PlanarEdge> edges);

/// A directed edge with the inside of a region to its left.
struct BoundaryEdge {
    std::uint32_t from = 0;  ///< index of a cell
    std::uint32_t to = 0;    ///< index of a cell
};

/// The edges of a subdivision that separate the inside of a region from its outside, by
/// `is_inside(winding number)`.
template <class IsInside>
[[nodiscard]] std::vector<BoundaryEdge> boundary_edges(std::span<const Cell> cells,
                                                       std::span<const PlanarEdge> edges,
                                                       const IsInside& is_inside) {
    const std::vector<std::int32_t> right = windings_to_the_right(cells, edges);
    std::vector<BoundaryEdge> boundary;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const bool inside_right = is_inside(right[i]);
        const bool inside_left = is_inside(right[i] + edges[i].weight);
        if (inside_left && !inside_right) {
            boundary.push_back({edges[i].low, edges[i].high});
        } else if (inside_right && !inside_left) {
            boundary.push_back({edges[i].high, edges[i].low});
        }
    }
    return boundary;
}

/// Joins boundary edges to closed rings of cells that do not cross: where several edges end, each
/// is followed along the inside of the region. Leaves out vertices on straight lines.
[[nodiscard]] std::vector<std::vector<Cell>> join_to_rings(std::span<const Cell> cells,
                                                           std::span<const BoundaryEdge> boundary);

}  // namespace nearfield::outline
