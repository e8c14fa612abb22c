#pragma once

#include <engine/plan/compute_work.hpp>
#include <engine/plan/edge_stack.hpp>
#include <engine/plan/tile_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Finds for each block of a tile the edges that can be nearest to any place in it: a quadtree over
/// the blocks, on the way down which edges drop out.
class BlockEdges {
public:
    /// `slack`: how far, in cells, the true boundary may be off; within it, its nearest edge is
    /// found as well as the simplified one's.
    void find(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
              double slack);

    /// Blocks are numbered row by row.
    [[nodiscard]] static std::uint32_t along(std::uint32_t cells) {
        return (cells + block_side - 1) / block_side;
    }
    /// The edges of a block, in ring order and in cells of the tile, appended to `edges`.
    void append(std::uint32_t block, std::vector<TileEdge>& edges) const;
    /// The same relative to the block's low corner, or what of them lies near the tile.
    void append(std::uint32_t block, std::vector<SegmentData>& segments) const;
    /// How far from the centre of the tile anything in any list can matter.
    [[nodiscard]] double window() const { return window_; }

private:
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    void find_candidates(const TileBoundary& boundary, double slack);
    void visit(std::uint32_t column, std::uint32_t row, std::uint32_t count, std::size_t first,
               std::size_t end);
    /// The box of `count` blocks along each side, or what of it lies in the tile.
    [[nodiscard]] EdgeNode node(std::uint32_t column, std::uint32_t row, std::uint32_t count) const;

    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    double window_ = 0.0;
    float slack_ = 0.0F;          // between two distances
    std::vector<TileEdge> near_;  // all that can matter somewhere in the tile, in ring order
    // Edges, or what of them lies near the tile, relative to its centre; by place in near_.
    EdgeStack candidates_;       // one list a level
    EdgeStack listed_;           // of all blocks
    std::vector<Range> blocks_;  // in listed_
};

}  // namespace nearfield::plan
