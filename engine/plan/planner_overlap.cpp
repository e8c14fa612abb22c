#include <engine/base/stopwatch.hpp>
#include <engine/geometry/magnitude.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/gpu_layout.hpp>
#include <engine/plan/planner.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::plan {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;

constexpr double bytes_per_tile = sizeof(Tile) + sizeof(TileSummary) + 64.0;

}  // namespace

void Planner::add(const IntersectionQuery& query, IntersectionResult& result) {
    PlannedQuery& planned = plan_->queries[query_];
    // The CPU's answers must not depend on the device.
    const geometry::SubpixelGrid grid = planned.on_cpu ? geometry::cpu_grid : limits_.subpixel;
    planned.budget = intersection_budget(query, grid, planned.deviations);
    result.error_bound = planned.budget.bound;
    result.cell = planned.budget.cell;
    result.kind = query.kind;
    result.strategy = query.strategy;
    const TransformedPolygon a(*planned.a, query.a.pose);
    const TransformedPolygon b(*planned.b, query.b.pose);
    const Box box_a = a.box();
    const Box box_b = b.box();
    if (!check_strategy(query.strategy, result) || !check_boxes(box_a, box_b, result)) {
        return;
    }
    const Stopwatch start;
    if (query.kind == IntersectionKind::volume_volume) {
        find_common_volume(a, b, box_a.intersection(box_b), result);
    } else {
        find_near_boundary(query.kind, a, b, box_b, result);
    }
    localize_milliseconds_ += start.milliseconds();

    add_regions(planned.budget.cell, result);
    if (planned.resident && !check_resident(query, result)) {
        return;
    }
    require_memory(bytes_of_samples(query) + (planned.by_compute ? bytes_of_masks(2) : 0.0),
                   query.tolerance, 2.0);
    require_sides(query.tolerance);
    planned.first_cpu_tile = static_cast<std::uint32_t>(plan_->cpu_tiles.size());
    for (std::uint32_t region = 0; region < grids_.size(); ++region) {
        cut_into_tiles(region, TileKind::overlap, limits_.largest_tile, 0);
    }
    planned.cpu_tile_count =
        static_cast<std::uint32_t>(plan_->cpu_tiles.size()) - planned.first_cpu_tile;
}

bool Planner::check_strategy(IntersectionStrategy strategy, ResultSummary& result) const {
    const PlannedQuery& planned = plan_->queries[query_];
    const auto& missing = limits_.missing_for_strategy[static_cast<std::size_t>(strategy)];
    if (missing.empty() || planned.on_cpu || planned.by_compute) {
        return true;
    }
    result.status = {StatusCode::unsupported_strategy,
                     std::string("the device lacks what the intersection strategy ") +
                         to_string(strategy) + " needs; each reason names one thing",
                     missing};
    return false;
}

bool Planner::check_boxes(const Box& a, const Box& b, ResultSummary& result) const {
    const PlannedQuery& planned = plan_->queries[query_];
    result.status = check_deviations(result.tolerance, planned.deviations, planned.budget.bound);
    if (result.status.ok()) {
        result.status = check_resolution(
            result.tolerance,
            std::max(geometry::largest_magnitude(a), geometry::largest_magnitude(b)));
    }
    return result.status.ok();
}

void Planner::find_common_volume(const TransformedPolygon& a, const TransformedPolygon& b,
                                 const Box& within, ResultSummary& result) {
    // The boundary of the overlap consists of the parts of either boundary in the other volume: one
    // box covers it all.
    chains_.clear();
    count(localize::chains_in_each_other(a, b, overlap_options(0.0), chains_, chains_), result);
    if (!chains_.empty()) {
        for (const localize::Chain& chain : chains_) {
            chains_.front().box.extend(chain.box);
        }
        chains_.resize(1);
    }
    join_chain_boxes(within, 0.0);
}

void Planner::find_near_boundary(IntersectionKind kind, const TransformedPolygon& a,
                                 const TransformedPolygon& b, const Box& within,
                                 ResultSummary& result) {
    const double grow = plan_->queries[query_].budget.bound;
    chains_.clear();
    count(kind == IntersectionKind::boundary_volume
              ? localize::chains_in_volume(a, b, overlap_options(grow), chains_)
              : localize::chains_near_boundary(a, b, overlap_options(2.0 * grow), chains_),
          result);
    join_chain_boxes(geometry::grown(within, grow), grow);
}

/// Memory for the tiles of the query's grids themselves, where nothing is kept for their cells.
double Planner::bytes_of_tiles() const {
    double tiles = 0.0;
    for (const Grid& grid : grids_) {
        const double side = limits_.largest_tile;
        tiles += std::ceil(static_cast<double>(grid.width) / side) *
                 std::ceil(static_cast<double>(grid.height) / side);
    }
    return tiles * bytes_per_tile;
}

}  // namespace nearfield::plan
