#include <engine/base/stopwatch.hpp>
#include <engine/device_input/check_target.hpp>
#include <engine/device_input/compute_work.hpp>
#include <engine/device_input/overlap_planner.hpp>
#include <engine/queries/check_query.hpp>
#include <nearfield/on_device.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::device_input {
namespace {

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
    const std::uint64_t bytes = queries::max_shape_bytes(*planned.a, *planned.b);
    if (planned.technique != Technique::compute || bytes <= current.limits.largest_range) {
        return true;
    }
    result.status = {StatusCode::too_large, "for Technique::compute the shapes may take " +
                                                std::to_string(bytes) +
                                                " bytes; a storage buffer of this device holds " +
                                                std::to_string(current.limits.largest_range)};
    return false;
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
            geometry::number(cells) + " cells, more than the " +
            geometry::number(std::floor(most)) +
            (query.samples_on_device
                 ? " that a storage buffer of this device has room for; use a larger tolerance, or "
                   "leave the samples out (samples_on_device)"
                 : " that it can count; use a larger tolerance")};
    return false;
}

}  // namespace

void OverlapPlanner::plan(const IntersectionQuery& query, CurrentQuery& current,
                          IntersectionResult& result) {
    const queries::QueryLimits& limits = current.limits;
    const PlannedQuery& planned = current.planned();
    if (!check_strategy(query.strategy, current, result) || !check_shapes(current, result)) {
        return;
    }
    const Stopwatch start;
    const bool is_covered = overlaps_.cover(planned, limits, result);
    current.plan.localize_milliseconds += start.milliseconds();
    const queries::Regions& regions = overlaps_.regions();
    if (!is_covered || (planned.on_device &&
                        !check_resident(query, regions.cells(), limits.largest_range, result))) {
        return;
    }
    current.memory.require(overlaps_.bytes_of_samples(query, limits.largest_tile) +
                               (planned.technique == Technique::compute
                                    ? bytes_of_masks(regions, 2, limits.largest_tile)
                                    : 0.0),
                           2.0);
    regions.require_sides(current.index, query.tolerance);
    add_tiles(regions, TileKind::overlap, limits.largest_tile, 0, current);
}

}  // namespace nearfield::device_input
