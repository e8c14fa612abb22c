#pragma once

#include <engine/geometry/vector.hpp>
#include <engine/queries/grid.hpp>
#include <engine/queries/simplified_boundary.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::queries {

/// Consecutive edges of a shape.
struct EdgeRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Edges longer than this, in cells, represent only themselves in the tiles' simplified boundaries:
/// their far ends may be cut off, so that the rest has coordinates that a float can resolve.
inline constexpr double longest_tile_run = 64.0;

/// An edge as seen by one tile, in cells of the tile.
struct TileEdge {
    geometry::Vector a;
    geometry::Vector b;
    /// The simplified edge that this is, or is a part of; no_simplified: a chain right of the tile,
    /// of which only the rows it spans matter.
    std::uint32_t simplified = 0;
};
inline constexpr std::uint32_t no_simplified = UINT32_MAX;

/// A simplified boundary in cells of a tile. End points are transformed on demand, since a tile
/// only needs those near it.
class TileBoundary {
public:
    TileBoundary(const SimplifiedBoundary& simplified, const ToCells& to_cells)
        : simplified_(simplified),
          to_cells_(to_cells),
          rounding_(to_cells.rounding(simplified.boxes.back())) {}

    [[nodiscard]] const SimplifiedBoundary& simplified() const { return simplified_; }
    [[nodiscard]] const ToCells& to_cells() const { return to_cells_; }
    [[nodiscard]] std::uint32_t size() const { return simplified_.size(); }
    [[nodiscard]] const geometry::SimplifiedEdge& edge(std::uint32_t edge) const {
        return simplified_.edges[edge];
    }
    [[nodiscard]] geometry::Vector start(std::uint32_t edge) const {
        return to_cells_(simplified_.polygon->vertices()[simplified_.edges[edge].first]);
    }
    [[nodiscard]] geometry::Vector end(std::uint32_t edge) const {
        return to_cells_(simplified_.polygon->vertices()[simplified_.edges[edge].last]);
    }

    /// Distance from a point to the simplified boundary, in cells.
    [[nodiscard]] double distance(const geometry::Vector& point) const;
    [[nodiscard]] double distance(const geometry::Vector& point, std::uint32_t edge) const;

    /// Calls `visit(edge)` in order for every edge within `reach` cells of a point, and for some
    /// others.
    template <class Visit>
    void for_edges_near(const geometry::Vector& point, double reach, Visit&& visit) const {
        const geometry::Vector local = to_cells_.inverse(point);
        simplified_.traverse(
            [&](const geometry::Box& box, std::uint32_t, std::uint32_t) {
                return to_cells_.cells(box.exteriorDistance(local)) <= reach + rounding_;
            },
            visit);
    }

    /// Calls `visit(edge)` in order for every edge whose offset polygon may reach a tile, and for
    /// some others; `offset` in cells.
    template <class Visit>
    void for_offset_edges(std::uint32_t width, std::uint32_t height, double offset,
                          Visit&& visit) const {
        const geometry::Vector centre(0.5 * width, 0.5 * height);
        // Offset polygons reach a little farther than the offset.
        for_edges_near(centre, centre.norm() + 2.0 * offset + 2.0, visit);
    }

    /// A box that encloses all of `box`, in cells; `box` is relative to the shape's centre.
    [[nodiscard]] geometry::Box in_cells(const geometry::Box& box) const {
        return geometry::grown(to_cells_(box), rounding_);
    }

private:
    SimplifiedBoundary simplified_;
    ToCells to_cells_;
    double rounding_;  // in cells
};

/// Appends every edge that a ray towards +x from a point of the tile can cross: edges in the tile's
/// rows that are not left of it. Chains wholly right of the tile are replaced by one vertical edge
/// that spans the same rows, which preserves the parity. `slack`: how far, in cells, the true
/// boundary may be from its simplified edges.
void crossing_edges(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
                    double slack, std::vector<TileEdge>& edges);

}  // namespace nearfield::queries
