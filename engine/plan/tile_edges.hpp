#pragma once

#include <cstdint>
#include <vector>

#include <engine/geometry/simplify.hpp>
#include <engine/geometry/vector.hpp>
#include <engine/plan/grid.hpp>

namespace nearfield::plan {

/// An edge as one tile sees it, in cells of the tile.
struct TileEdge {
    geometry::Vector a;
    geometry::Vector b;
    /// Which simplified edge it is (or a part of); no_simplified: a chain right of the tile, of
    /// which only the rows it spans matter.
    std::uint32_t simplified = 0;
};
inline constexpr std::uint32_t no_simplified = UINT32_MAX;

/// A simplified boundary in cells of a tile: end points of every simplified edge, ring after ring.
/// Reused from tile to tile.
struct TileBoundary {
    const geometry::Polygon* polygon = nullptr;
    const std::vector<geometry::SimplifiedEdge>* edges = nullptr;
    std::vector<geometry::Vector> starts;  ///< by simplified edge: where it starts
    std::vector<std::uint32_t> next;       ///< by simplified edge: the one after it on its ring
    std::vector<std::uint32_t> previous;

    [[nodiscard]] const geometry::Vector& start(std::uint32_t edge) const { return starts[edge]; }
    [[nodiscard]] const geometry::Vector& end(std::uint32_t edge) const {
        return starts[next[edge]];
    }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(starts.size()); }

    /// Transforms all end points.
    void place(const geometry::Polygon& shape, const std::vector<geometry::SimplifiedEdge>& simplified,
               const ToCells& to_cells);
};

/// Appends every edge that a ray towards +x from a point of the tile can cross: edges in the tile's
/// rows that are not left of it. Chains wholly right of the tile are replaced by one vertical edge
/// that spans the same rows, which changes no parity. `slack`: how far, in cells, the true boundary
/// may be from its simplified edges.
void crossing_edges(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
                    double slack, std::vector<TileEdge>& edges);

/// A square part of a tile that holds samples whose nearest feature is asked for.
struct NeededBlock {
    geometry::Vector centre;  ///< in cells of the tile
    double half_diagonal = 0.0;
};

/// The edges that can be nearest to a needed sample, with the distance out to which each can.
struct NearestEdges {
    std::vector<TileEdge> edges;  ///< in ring order
    std::vector<double> reach;    ///< by edge: farther than this from it, another edge is nearer
    double largest_reach = 0.0;

    void clear();
};

/// Finds them by upper bounds: a block's samples are no farther from the boundary than its centre
/// is, plus half its diagonal. `slack` as above: the true boundary's nearest edge is among those
/// found, and so is the simplified one's.
class NearestEdgeFinder {
public:
    void find(const TileBoundary& boundary, const std::vector<NeededBlock>& blocks, double slack,
              NearestEdges& result);

private:
    void keep_candidates(const TileBoundary& boundary, const std::vector<NeededBlock>& blocks,
                         double slack);

    std::vector<std::uint32_t> candidates_;  // simplified edges that can be nearest to any block
    std::vector<float> squared_;             // by candidate: squared distance to a point
    std::vector<double> reach_;              // by candidate
    std::vector<float> ax_, ay_, dx_, dy_, inverse_length_;  // by candidate, for the inner loop
};

}  // namespace nearfield::plan
