#include <engine/geometry/magnitude.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/check_target.hpp>
#include <engine/plan/overlap_planner.hpp>
#include <engine/plan/search_shapes.hpp>
#include <nearfield/on_device.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::plan {
namespace {

using geometry::Box;
using geometry::TransformedPolygon;

constexpr double bytes_per_tile = sizeof(Tile) + sizeof(TileSummary) + 64.0;

// Host memory per sample: in the result and in the buffers on the way there.
constexpr double bytes_per_sample = sizeof(IntersectionSample) + 48.0;

// Memory per cell with a resident sample: its hit, or its run of edges, and space for the sample.
constexpr double bytes_per_resident_cell = sizeof(std::uint32_t) + sizeof(IntersectionSampleData);

/// Memory for an intersection in these regions, without bit masks.
double bytes_of_samples(const IntersectionQuery& query, const Regions& regions,
                        double largest_tile) {
    const double cells = regions.cells();
    const bool stay = query.on_device && query.samples_on_device;
    return (!query.summary_only ? bytes_per_sample * cells
                                : bytes_per_tile * regions.tiles(largest_tile)) +
           (stay ? bytes_per_resident_cell * cells : 0.0);
}

/// Checks that the device has what a strategy needs, if it draws; the result states the error.
bool check_strategy(IntersectionStrategy strategy, const CurrentQuery& current,
                    ResultSummary& result) {
    const PlannedQuery& planned = current.planned();
    const auto& missing = current.limits.missing_for_strategy[static_cast<std::size_t>(strategy)];
    if (missing.empty() || planned.technique != Technique::raster) {
        return true;
    }
    result.status = {StatusCode::unsupported_strategy,
                     std::string("the device lacks what the intersection strategy ") +
                         to_string(strategy) + " needs; each reason names one thing",
                     missing};
    return false;
}

/// Checks that the shapes fit into a storage buffer of the device, if it reads them; the result
/// states the error.
bool check_shapes(const CurrentQuery& current, ResultSummary& result) {
    const PlannedQuery& planned = current.planned();
    const std::uint64_t bytes = max_shape_bytes(*planned.a, *planned.b);
    if (planned.technique != Technique::compute || bytes <= current.limits.largest_range) {
        return true;
    }
    result.status = {StatusCode::too_large, "for Technique::compute the shapes may take " +
                                                std::to_string(bytes) +
                                                " bytes; a storage buffer of this device holds " +
                                                std::to_string(current.limits.largest_range)};
    return false;
}

/// Checks that the deviations and the boxes of both shapes are compatible with the tolerance; the
/// result states the error.
bool check_boxes(const PlannedQuery& planned, const Box& a, const Box& b, ResultSummary& result) {
    result.status = check_deviations(result.tolerance, planned.deviations, planned.budget.bound);
    if (result.status.ok()) {
        result.status = check_resolution(
            result.tolerance,
            std::max(geometry::largest_magnitude(a), geometry::largest_magnitude(b)));
    }
    return result.status.ok();
}

/// Checks that the samples fit where they are to stay: either every cell has space, or the query is
/// rejected before any work.
bool check_resident(const IntersectionQuery& query, double cells, std::uint64_t largest_range,
                    IntersectionResult& result) {
    const double max_counted = UINT32_MAX;
    const double room = static_cast<double>(largest_range - sizeof(IntersectionSummaryData)) /
                        sizeof(IntersectionSampleData);
    const double most = query.samples_on_device ? std::min(room, max_counted) : max_counted;
    if (cells <= most && query.target == nullptr) {
        return true;
    }
    if (cells <= most) {
        const double samples = query.samples_on_device ? cells * sizeof(IntersectionSampleData) : 0;
        result.status =
            check_room(*query.target, sizeof(IntersectionSummaryData) + samples, "samples");
        return result.status.ok();
    }
    result.status = {
        StatusCode::too_large,
        std::string("an intersection whose ") + (query.samples_on_device ? "samples" : "summary") +
            (query.samples_on_device ? " are" : " is") + " to stay on the device has " +
            number(cells) + " cells, more than the " + number(std::floor(most)) +
            (query.samples_on_device
                 ? " that a storage buffer of this device has room for; use a larger tolerance, or "
                   "leave the samples out (samples_on_device)"
                 : " that it can count; use a larger tolerance")};
    return false;
}

}  // namespace

void OverlapPlanner::plan(const IntersectionQuery& query, CurrentQuery& current,
                          IntersectionResult& result) {
    const PlanLimits& limits = current.limits;
    PlannedQuery& planned = current.planned();
    auto& overlap = planned.work.emplace<PlannedOverlap>();
    const bool on_cpu = planned.technique == Technique::cpu;
    // The CPU's answers must not depend on the device.
    const geometry::SubpixelGrid grid = on_cpu ? geometry::cpu_grid : limits.subpixel;
    planned.budget = intersection_budget(query, grid, planned.deviations);
    result.error_bound = planned.budget.bound;
    result.cell = planned.budget.cell;
    result.kind = query.kind;
    result.strategy = query.strategy;
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const Box box_a = a.box();
    const Box box_b = b.box();
    if (!check_strategy(query.strategy, current, result) || !check_shapes(current, result) ||
        !check_boxes(planned, box_a, box_b, result)) {
        return;
    }
    if (query.kind == IntersectionKind::volume_volume) {
        cover_common_volume(a, b, box_a.intersection(box_b), current, result);
    } else {
        cover_boundary(query.kind, a, b, box_b, current, result);
    }
    if (planned.on_device &&
        !check_resident(query, regions_.cells(), limits.largest_range, result)) {
        return;
    }
    current.memory.require(bytes_of_samples(query, regions_, limits.largest_tile) +
                               (planned.technique == Technique::compute
                                    ? regions_.bytes_of_masks(2, limits.largest_tile)
                                    : 0.0),
                           2.0);
    regions_.require_sides(current.index, query.tolerance);
    // Tiles of queries that the CPU answers are kept apart.
    std::vector<Tile>& cpu_tiles = current.plan.cpu_tiles;
    overlap.first_tile = static_cast<std::uint32_t>(cpu_tiles.size());
    regions_.cut_into_tiles(current.index, TileKind::overlap, limits.largest_tile, 0,
                            on_cpu ? cpu_tiles : current.plan.tiles);
    overlap.tile_count = static_cast<std::uint32_t>(cpu_tiles.size()) - overlap.first_tile;
}

void OverlapPlanner::cover_common_volume(const TransformedPolygon& a, const TransformedPolygon& b,
                                         const Box& within, CurrentQuery& current,
                                         ResultSummary& result) {
    find_chains(current.plan, result, chains_, [&] {
        return localize::chains_in_each_other(a, b, current.overlap_options(0.0), chains_, chains_);
    });
    // The boundary of the overlap consists of the parts of either boundary in the other volume: one
    // box covers it all.
    if (!chains_.empty()) {
        for (const localize::Chain& chain : chains_) {
            chains_.front().box.extend(chain.box);
        }
        chains_.resize(1);
    }
    regions_.cover(chains_, 0.0, within, result);
}

void OverlapPlanner::cover_boundary(IntersectionKind kind, const TransformedPolygon& a,
                                    const TransformedPolygon& b, const Box& within,
                                    CurrentQuery& current, ResultSummary& result) {
    const double grow = current.planned().budget.bound;
    find_chains(current.plan, result, chains_, [&] {
        return kind == IntersectionKind::boundary_volume
                   ? localize::chains_in_volume(a, b, current.overlap_options(grow), chains_)
                   : localize::chains_near_boundary(a, b, current.overlap_options(2.0 * grow),
                                                    chains_);
    });
    regions_.cover(chains_, grow, geometry::grown(within, grow), result);
}

}  // namespace nearfield::plan
