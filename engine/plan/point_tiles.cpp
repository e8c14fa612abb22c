#include <engine/base/interruption.hpp>
#include <engine/plan/point_tiles.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::plan {
namespace {

using geometry::Box;
using geometry::Vector;

std::uint32_t box_of(const Vector& p, const std::vector<Box>& boxes, std::uint32_t first_guess) {
    std::uint32_t box = first_guess;
    double nearest = boxes[box].squaredExteriorDistance(p);
    for (std::uint32_t i = 0; i < boxes.size() && nearest > 0.0; ++i) {
        const double distance = boxes[i].squaredExteriorDistance(p);
        if (distance < nearest) {
            nearest = distance;
            box = i;
        }
    }
    return box;
}

/// Towards 0, which is below: what would be negative is 0.
std::uint64_t index_along(double coordinate, std::uint64_t count) {
    return static_cast<std::uint64_t>(std::clamp(coordinate, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

void PointTiles::spread(const geometry::TransformedPolygon& a,
                        const std::vector<BoundaryPoint>& samples, const Box& within,
                        const std::vector<Box>& boxes, const std::vector<Grid>& grids,
                        std::uint32_t query, Plan& plan) {
    find_runs(a, samples, within, boxes, grids);
    const std::size_t first_tile = plan.tiles.size();
    add_tiles(grids, query, plan);
    const auto tile_of = [&](const Run& run) {
        const auto found = std::lower_bound(keys_.begin(), keys_.end(), run.key);
        return first_tile + static_cast<std::size_t>(found - keys_.begin());
    };
    for (const Run& run : runs_) {
        include(run, plan.tiles[tile_of(run)]);
    }
    for (std::size_t i = first_tile; i < plan.tiles.size(); ++i) {
        plan.tiles[i].needed = NeededBlocks(plan.tiles[i].width, plan.tiles[i].height);
    }
    for (const Run& run : runs_) {
        const std::size_t index = tile_of(run);
        Tile& tile = plan.tiles[index];
        for (std::size_t i = run.first; i < run.end; ++i) {
            plan.points.push_back({kept_[i], static_cast<std::uint32_t>(index)});
            tile.needed.add(static_cast<std::uint32_t>(cells_[i].column - tile.column),
                            static_cast<std::uint32_t>(cells_[i].row - tile.row));
        }
    }
}

void PointTiles::find_runs(const geometry::TransformedPolygon& a,
                           const std::vector<BoundaryPoint>& samples, const Box& within,
                           const std::vector<Box>& boxes, const std::vector<Grid>& grids) {
    kept_.clear();
    cells_.clear();
    runs_.clear();
    BoundaryPositions position(a);
    std::uint32_t grid = 0;
    SparseCheckpoint<64> checkpoint;
    for (const BoundaryPoint& sample : samples) {
        checkpoint.step();
        const Vector p = position(sample);
        if (!within.contains(p)) {
            continue;
        }
        // Samples come in order along the boundary: the last one's region is tried first.
        grid = box_of(p, boxes, grid);
        const Vector local = (p - grids[grid].origin) / grids[grid].cell;
        add_to_run(grid, {index_along(local.x(), grids[grid].width),
                          index_along(local.y(), grids[grid].height)});
        kept_.push_back(sample);
    }
}

void PointTiles::add_to_run(std::uint32_t grid, const PointCell& cell) {
    const std::size_t point = cells_.size();
    cells_.push_back(cell);
    if (!runs_.empty()) {
        Run& run = runs_.back();
        // Nothing divided: most points are in the tile of the one before.
        if (run.key.grid == grid && cell.row - run.key.row * side_ < side_ &&
            cell.column - run.key.column * side_ < side_) {
            run.end = point + 1;
            run.low = {std::min(run.low.column, cell.column), std::min(run.low.row, cell.row)};
            run.high = {std::max(run.high.column, cell.column), std::max(run.high.row, cell.row)};
            return;
        }
    }
    runs_.push_back({{grid, cell.row / side_, cell.column / side_}, point, point + 1, cell, cell});
}

void PointTiles::add_tiles(const std::vector<Grid>& grids, std::uint32_t query, Plan& plan) {
    keys_.clear();
    for (const Run& run : runs_) {
        keys_.push_back(run.key);
    }
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    for (const TileKey& key : keys_) {
        Tile& tile = plan.tiles.emplace_back();
        tile.query = query;
        tile.kind = TileKind::points;
        tile.region = key.grid;
        tile.grid = grids[key.grid];
    }
}

void PointTiles::include(const Run& run, Tile& tile) {
    if (tile.width == 0) {
        tile.column = run.low.column;
        tile.row = run.low.row;
    }
    const std::uint64_t right = std::max(tile.column + tile.width, run.high.column + 1);
    const std::uint64_t top = std::max(tile.row + tile.height, run.high.row + 1);
    tile.column = std::min(tile.column, run.low.column);
    tile.row = std::min(tile.row, run.low.row);
    tile.width = static_cast<std::uint32_t>(right - tile.column);
    tile.height = static_cast<std::uint32_t>(top - tile.row);
}

}  // namespace nearfield::plan
