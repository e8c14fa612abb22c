#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/region.hpp>
#include <engine/plan/regions.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::plan {

using geometry::Box;

void Regions::set(const Grid& grid) {
    boxes_.clear();
    grids_.assign(1, grid);
}

void Regions::cover(const std::vector<localize::Chain>& chains, double grow, const Box& within,
                    ResultSummary& result) {
    boxes_.clear();
    for (const localize::Chain& chain : chains) {
        const Box box = geometry::grown(chain.box, grow).intersection(within);
        if (!box.isEmpty()) {
            boxes_.push_back(box);
        }
    }
    localize::join_boxes(boxes_);
    std::sort(boxes_.begin(), boxes_.end(), [](const Box& i, const Box& j) {
        return i.min().y() != j.min().y() ? i.min().y() < j.min().y() : i.min().x() < j.min().x();
    });
    make_grids(result);
}

void Regions::make_grids(ResultSummary& result) {
    grids_.clear();
    for (const Box& box : boxes_) {
        result.regions.push_back(region_of(grids_.emplace_back(Grid::covering(box, result.cell))));
    }
}

double Regions::cells() const {
    double cells = 0.0;
    for (const Grid& grid : grids_) {
        cells += grid.cells();
    }
    return cells;
}

double Regions::tiles(double side) const {
    double tiles = 0.0;
    for (const Grid& grid : grids_) {
        tiles += std::ceil(static_cast<double>(grid.width) / side) *
                 std::ceil(static_cast<double>(grid.height) / side);
    }
    return tiles;
}

double Regions::bytes_of_masks(int masks, double largest_tile) const {
    double bytes = 0.0;
    for (const Grid& grid : grids_) {
        const double across = std::ceil(static_cast<double>(grid.width) / largest_tile);
        const double rows = across * static_cast<double>(grid.height);
        bytes += masks * (grid.cells() / 8.0 + sizeof(std::uint32_t) * rows);
    }
    return bytes;
}

void Regions::require_sides(std::uint32_t query, double tolerance) const {
    for (const Grid& grid : grids_) {
        if (std::max(grid.width, grid.height) > UINT32_MAX) {
            throw StatusException({StatusCode::too_large,
                                   "query " + std::to_string(query) + " with tolerance " +
                                       number(tolerance) + " has a region of " +
                                       std::to_string(grid.width) + " x " +
                                       std::to_string(grid.height) + " cells; a side has at most " +
                                       std::to_string(UINT32_MAX)});
        }
    }
}

void Regions::cut_into_tiles(std::uint32_t query, TileKind kind, std::uint32_t side,
                             std::uint32_t halo, std::vector<Tile>& tiles) const {
    for (std::uint32_t region = 0; region < grids_.size(); ++region) {
        const Grid& grid = grids_[region];
        const auto drawn = [&](std::uint64_t cells) {
            return static_cast<std::uint32_t>(std::min<std::uint64_t>(side, cells)) + 2 * halo;
        };
        for (std::uint64_t row = 0; row < grid.height; row += side) {
            checkpoint();
            for (std::uint64_t column = 0; column < grid.width; column += side) {
                Tile& tile = tiles.emplace_back();
                tile.query = query;
                tile.kind = kind;
                tile.region = region;
                tile.grid = grid;
                tile.column = column;
                tile.row = row;
                tile.halo = halo;
                tile.width = drawn(grid.width - column);
                tile.height = drawn(grid.height - row);
                if (kind == TileKind::field) {
                    tile.needed = NeededBlocks(tile.width, tile.height);
                    tile.needed.add_all();
                }
            }
        }
    }
}

}  // namespace nearfield::plan
