#pragma once

#include <engine/plan/tile_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::plan {

/// Finds for each part of a tile the edges that can be nearest to any place in it: a quadtree over
/// the parts, on the way down which edges drop out. As shaders/list_blocks.comp goes on below the
/// parts: an edge whose distance's tangent at the centre of a node lies above the distance to the
/// edge nearest to the centre, at all four corners, is nearest nowhere in the node.
class PartEdges {
public:
    /// Cells along a side of a part, but for those at the tile's high borders.
    static constexpr std::uint32_t side = 32;

    /// `slack`: how far, in cells, the true boundary may be off; within it, its nearest edge is
    /// found as well as the simplified one's.
    void find(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
              double slack);

    /// Parts are numbered row by row.
    [[nodiscard]] static std::uint32_t along(std::uint32_t cells) {
        return (cells + side - 1) / side;
    }
    /// The edges of a part, in ring order and in cells of the tile, appended to `edges`.
    void append(std::uint32_t part, std::vector<TileEdge>& edges) const;
    /// How far from the centre of the tile anything in any list can matter.
    [[nodiscard]] double window() const { return window_; }

private:
    /// An edge, or what of it lies near the tile, relative to the tile's centre.
    struct Candidate {
        float ax, ay, dx, dy;
        float inverse_squared_length;
        std::uint32_t edge;  // in near_
    };
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    void find_candidates(const TileBoundary& boundary, double slack);
    void visit(std::uint32_t column, std::uint32_t row, std::uint32_t count, std::size_t first,
               std::size_t end);
    /// Appends to the stack what of candidates first, ..., end - 1 can be nearest in a box.
    void keep(float low_x, float low_y, float high_x, float high_y, std::size_t first,
              std::size_t end);

    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    double window_ = 0.0;
    float slack_ = 0.0F;                 // between two distances
    std::vector<TileEdge> near_;         // all that can matter somewhere in the tile, in ring order
    std::vector<Candidate> candidates_;  // a stack: one list a level
    std::vector<float> away_x_, away_y_, squared_;  // by place on the stack: from the nearest point
    std::vector<Range> parts_;                      // in listed_
    std::vector<std::uint32_t> listed_;             // in near_
};

}  // namespace nearfield::plan
