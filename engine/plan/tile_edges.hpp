#pragma once

#include <engine/geometry/simplify.hpp>
#include <engine/geometry/vector.hpp>
#include <engine/plan/grid.hpp>

#include <cstdint>
#include <vector>

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

    /// From a point to the simplified boundary, in cells.
    [[nodiscard]] double distance(const geometry::Vector& point) const;

    /// Transforms all end points.
    void place(const geometry::Polygon& shape,
               const std::vector<geometry::SimplifiedEdge>& simplified, const ToCells& to_cells);
};

/// Appends every edge that a ray towards +x from a point of the tile can cross: edges in the tile's
/// rows that are not left of it. Chains wholly right of the tile are replaced by one vertical edge
/// that spans the same rows, which changes no parity. `slack`: how far, in cells, the true boundary
/// may be from its simplified edges.
void crossing_edges(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
                    double slack, std::vector<TileEdge>& edges);

}  // namespace nearfield::plan
