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

std::uint64_t index_along(double coordinate, std::uint64_t count) {
    const double last = static_cast<double>(count - 1);
    return static_cast<std::uint64_t>(std::clamp(std::floor(coordinate), 0.0, last));
}

}  // namespace

void PointTiles::spread(const geometry::TransformedPolygon& a,
                        const std::vector<BoundaryPoint>& samples, const Box& within,
                        const std::vector<Box>& boxes, const std::vector<Grid>& grids,
                        std::uint32_t query, Plan& plan) {
    find_cells(a, samples, within, boxes, grids);
    keys_.clear();
    for (const PointCell& cell : cells_) {
        // Consecutive points mostly share a tile.
        const TileKey key = tile_of(cell);
        if (keys_.empty() || keys_.back() != key) {
            keys_.push_back(key);
        }
    }
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());

    const auto first_tile = static_cast<std::uint32_t>(plan.tiles.size());
    for (const TileKey& key : keys_) {
        Tile& tile = plan.tiles.emplace_back();
        tile.query = query;
        tile.kind = TileKind::points;
        tile.region = key.grid;
        tile.grid = grids[key.grid];
    }
    for (std::size_t i = 0; i < kept_.size(); ++i) {
        const auto found = std::lower_bound(keys_.begin(), keys_.end(), tile_of(cells_[i]));
        plan.points.push_back(
            {kept_[i], first_tile + static_cast<std::uint32_t>(found - keys_.begin())});
    }
    trim_to_points(plan);
}

void PointTiles::find_cells(const geometry::TransformedPolygon& a,
                            const std::vector<BoundaryPoint>& samples, const Box& within,
                            const std::vector<Box>& boxes, const std::vector<Grid>& grids) {
    kept_.clear();
    cells_.clear();
    std::uint32_t grid = 0;
    SparseCheckpoint<64> checkpoint;
    for (const BoundaryPoint& sample : samples) {
        checkpoint.step();
        const Vector p = position(a, sample);
        if (!within.contains(p)) {
            continue;
        }
        // Samples come in order along the boundary: the last one's region is tried first.
        grid = box_of(p, boxes, grid);
        const Vector local = (p - grids[grid].origin) / grids[grid].cell;
        cells_.push_back({grid, index_along(local.x(), grids[grid].width),
                          index_along(local.y(), grids[grid].height)});
        kept_.push_back(sample);
    }
}

void PointTiles::trim_to_points(Plan& plan) const {
    const std::size_t first_point = plan.points.size() - cells_.size();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Tile& tile = plan.tiles[plan.points[first_point + i].tile];
        const PointCell& cell = cells_[i];
        if (tile.width == 0) {
            tile.column = cell.column;
            tile.row = cell.row;
        }
        const std::uint64_t right = std::max(tile.column + tile.width, cell.column + 1);
        const std::uint64_t top = std::max(tile.row + tile.height, cell.row + 1);
        tile.column = std::min(tile.column, cell.column);
        tile.row = std::min(tile.row, cell.row);
        tile.width = static_cast<std::uint32_t>(right - tile.column);
        tile.height = static_cast<std::uint32_t>(top - tile.row);
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Tile& tile = plan.tiles[plan.points[first_point + i].tile];
        if (tile.needed.empty()) {
            tile.needed = NeededBlocks(tile.width, tile.height);
        }
        tile.needed.add(static_cast<std::uint32_t>(cells_[i].column - tile.column),
                        static_cast<std::uint32_t>(cells_[i].row - tile.row));
    }
}

}  // namespace nearfield::plan
