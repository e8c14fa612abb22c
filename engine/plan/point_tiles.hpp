#pragma once

#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/plan.hpp>

#include <cstdint>
#include <tuple>
#include <vector>

namespace nearfield::plan {

/// Assigns a query's boundary points to tiles. Only areas that hold points become tiles.
class PointTiles {
public:
    /// Tiles of at most `side` x `side` cells.
    explicit PointTiles(std::uint32_t side) : side_(side) {}

    /// Appends the points of `samples` that lie in `within` to the plan, and the tiles they need.
    /// `boxes` and `grids` are the query's regions; a point belongs to the box that contains it, or
    /// to the nearest one if rounding left it outside all of them.
    void spread(const geometry::TransformedPolygon& a, const std::vector<BoundaryPoint>& samples,
                const geometry::Box& within, const std::vector<geometry::Box>& boxes,
                const std::vector<Grid>& grids, std::uint32_t query, Plan& plan);

private:
    struct PointCell {
        std::uint64_t column = 0;
        std::uint64_t row = 0;
    };
    struct TileKey {
        std::uint32_t grid = 0;
        std::uint64_t row = 0;
        std::uint64_t column = 0;
        bool operator==(const TileKey&) const = default;
        bool operator<(const TileKey& other) const {
            return std::tie(grid, row, column) < std::tie(other.grid, other.row, other.column);
        }
    };
    /// Consecutive points in the same tile.
    struct Run {
        TileKey key;
        std::size_t first = 0;  // among those kept
        std::size_t end = 0;
        PointCell low, high;  // of their cells, both included
    };

    void find_runs(const geometry::TransformedPolygon& a, const std::vector<BoundaryPoint>& samples,
                   const geometry::Box& within, const std::vector<geometry::Box>& boxes,
                   const std::vector<Grid>& grids);
    void add_to_run(std::uint32_t grid, const PointCell& cell);
    void add_tiles(const std::vector<Grid>& grids, std::uint32_t query, Plan& plan);
    /// Shrinks a tile's cells to those of the points in it.
    static void include(const Run& run, Tile& tile);

    std::uint32_t side_;
    std::vector<BoundaryPoint> kept_;  // samples that lie within
    std::vector<PointCell> cells_;     // by kept sample
    std::vector<Run> runs_;            // of them
    std::vector<TileKey> keys_;        // of the tiles, sorted
};

}  // namespace nearfield::plan
