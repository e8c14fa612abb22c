#pragma once

#include <engine/device_input/needed_blocks.hpp>
#include <engine/geometry/edge_list_kernels.hpp>
#include <engine/queries/tile_edges.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace nearfield::raster {

/// An edge that can be nearest to a needed sample, and the largest distance of such a sample from
/// it, in cells. A side without such samples has reach 0.
struct NearestEdge {
    queries::TileEdge edge;
    double reach_left = 0.0;  ///< left of the direction from a to b
    double reach_right = 0.0;
    [[nodiscard]] double reach() const { return std::max(reach_left, reach_right); }
};

/// Finds the edges that can be nearest to a needed sample of a tile. Descends a quadtree over the
/// tile's blocks and drops candidates at every level: a sample in a node is no farther from the
/// boundary than the node's centre plus half the node's diagonal, and an edge farther than that
/// from every sample is dropped.
class NearestEdgeFinder {
public:
    /// Replaces `result`, in ring order. `slack`: how far, in cells, the true boundary and a drawn
    /// distance may be off; the edge nearest on any boundary within it is found as well as the
    /// nearest simplified edge.
    void find(const queries::TileBoundary& boundary, const device_input::NeededBlocks& needed,
              double slack, std::vector<NearestEdge>& result);

private:
    void find_candidates(const queries::TileBoundary& boundary, double slack);
    void visit(std::uint32_t column, std::uint32_t row, std::uint32_t count, std::size_t first,
               std::size_t end);
    void reach_out(std::size_t first, std::size_t end, float x, float y, double limit,
                   double half_diagonal, double reach);

    const device_input::NeededBlocks* needed_ = nullptr;
    double slack_ = 0.0;
    std::vector<queries::TileEdge>
        near_;  // all that can matter somewhere in the tile, in ring order
    // Edges, cut to their parts near the tile, relative to its centre; indices are into near_.
    geometry::EdgeList candidates_;      // one list per level, a stack of them
    std::vector<float> squared_;         // by place among them: squared distance to the centre
    std::vector<float> inverse_length_;  // by near edge; 0 for an edge of no length
    std::vector<double> reach_left_;     // by near edge
    std::vector<double> reach_right_;
};

}  // namespace nearfield::raster
