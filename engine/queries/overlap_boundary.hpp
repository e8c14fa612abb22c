#pragma once

#include <engine/queries/error_budget.hpp>
#include <engine/queries/grid.hpp>
#include <engine/queries/simplified_shapes.hpp>
#include <engine/queries/tile_edges.hpp>

namespace nearfield::queries {

/// A boundary for one tile of an intersection: simplified near the tile and reduced to a few edges
/// elsewhere. Identical for raster and cpu, so that their samples are, too. Valid until the next
/// call to `shapes`.
[[nodiscard]] inline TileBoundary overlap_boundary(const geometry::Polygon& polygon,
                                                   const Pose& pose, const ErrorBudget& budget,
                                                   const Tile& tile, SimplifiedShapes& shapes) {
    const double cell = tile.grid.cell;
    const geometry::TransformedPolygon placed(polygon, pose);
    // Farther than crossing_edges() looks and offset polygons reach.
    const double beyond = 2.0 * budget.offset + budget.simplification + 4.0 * cell;
    const geometry::Box drawn(tile.origin(),
                              tile.origin() + cell * geometry::Vector(tile.width, tile.height));
    return {shapes.get_near(placed, geometry::grown(drawn, beyond), budget.simplification,
                            longest_tile_run * cell),
            ToCells(placed, tile.origin(), cell)};
}

}  // namespace nearfield::queries
