#pragma once

#include <engine/base/interruption.hpp>
#include <engine/plan/compute_work.hpp>
#include <engine/plan/edge_stack.hpp>
#include <engine/plan/tile_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Finds, for each block of a tile, the edges that can be nearest to any point in it. Descends a
/// quadtree over the blocks and drops edges at every level.
class BlockEdges {
public:
    /// `slack`: how far, in cells, the true boundary may be off; the edge nearest on any boundary
    /// within it is found as well as the nearest simplified edge.
    void find(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
              double slack);

    /// Number of blocks along a side of `cells` cells; blocks are numbered row by row.
    [[nodiscard]] static std::uint32_t along(std::uint32_t cells) {
        return (cells + block_side - 1) / block_side;
    }
    /// Appends the edges of a block to `edges`, in ring order and in cells of the tile.
    void append(std::uint32_t block, std::vector<TileEdge>& edges) const;
    /// The same edges relative to the block's low corner, each cut to its part near the tile.
    void append(std::uint32_t block, std::vector<SegmentData>& segments) const;
    /// Distance from the tile's centre, in cells, beyond which nothing in any list matters.
    [[nodiscard]] double window() const { return window_; }

private:
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    void find_candidates(const TileBoundary& boundary, double slack);
    void visit(std::uint32_t column, std::uint32_t row, std::uint32_t count, std::size_t first,
               std::size_t end);
    /// The box of `count` blocks along each side, clipped to the tile.
    [[nodiscard]] EdgeNode node(std::uint32_t column, std::uint32_t row, std::uint32_t count) const;

    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    double window_ = 0.0;
    float slack_ = 0.0F;          // between two distances
    std::vector<TileEdge> near_;  // all that can matter somewhere in the tile, in ring order
    // Edges, cut to their parts near the tile, relative to its centre; indices are into near_.
    EdgeStack candidates_;       // one list per level
    EdgeStack listed_;           // for all blocks
    std::vector<Range> blocks_;  // in listed_
    SparseCheckpoint<16> checkpoint_;
};

}  // namespace nearfield::plan
