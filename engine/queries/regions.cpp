#include <engine/base/status_exception.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/regions.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::queries {

using geometry::Box;

void Regions::set(const Grid& grid) {
    boxes_.clear();
    grids_.assign(1, grid);
}

void Regions::cover(const std::vector<geometry::Chain>& chains, double grow, const Box& within,
                    ResultSummary& result) {
    boxes_.clear();
    for (const geometry::Chain& chain : chains) {
        const Box box = geometry::grown(chain.box, grow).intersection(within);
        if (!box.isEmpty()) {
            boxes_.push_back(box);
        }
    }
    geometry::join_boxes(boxes_);
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

void Regions::require_sides(std::uint32_t query, double tolerance) const {
    for (const Grid& grid : grids_) {
        if (std::max(grid.width, grid.height) > UINT32_MAX) {
            throw StatusException({StatusCode::too_large,
                                   "query " + std::to_string(query) + " with tolerance " +
                                       geometry::number(tolerance) + " has a region of " +
                                       std::to_string(grid.width) + " x " +
                                       std::to_string(grid.height) + " cells; a side has at most " +
                                       std::to_string(UINT32_MAX)});
        }
    }
}

}  // namespace nearfield::queries
