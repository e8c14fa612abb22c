#include <engine/plan/check_query.hpp>
#include <engine/plan/planner.hpp>
#include <nearfield/resident.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace nearfield::plan {
namespace {

// Host memory per sample: in the result and in the buffers on the way there.
constexpr double bytes_per_sample = sizeof(IntersectionSample) + 48.0;

// Memory per cell with a resident sample: its hit, or its run of edges, and space for the sample.
constexpr double bytes_per_resident_cell = sizeof(std::uint32_t) + sizeof(IntersectionSampleData);

double cells_of(const std::vector<Grid>& grids) {
    double cells = 0.0;
    for (const Grid& grid : grids) {
        cells += grid.cells();
    }
    return cells;
}

}  // namespace

/// Memory for an intersection with the query's grids, without bit masks.
double Planner::bytes_of_samples(const IntersectionQuery& query) const {
    const double cells = cells_of(grids_);
    const bool stay = query.resident && query.resident_samples;
    return (query.records ? bytes_per_sample * cells : bytes_of_tiles()) +
           (stay ? bytes_per_resident_cell * cells : 0.0);
}

/// Either every cell has space or the query is rejected before any work.
bool Planner::check_resident(const IntersectionQuery& query, IntersectionResult& result) {
    const double cells = cells_of(grids_);
    const double max_counted = UINT32_MAX;
    const double room =
        static_cast<double>(limits_.largest_range - sizeof(IntersectionSummaryData)) /
        sizeof(IntersectionSampleData);
    const double most = query.resident_samples ? std::min(room, max_counted) : max_counted;
    if (cells <= most && query.target == nullptr) {
        return true;
    }
    if (cells <= most) {
        const double samples = query.resident_samples ? cells * sizeof(IntersectionSampleData) : 0;
        result.status =
            check_room(*query.target, sizeof(IntersectionSummaryData) + samples, "samples");
        return result.status.ok();
    }
    result.status = {
        StatusCode::too_large,
        std::string("an intersection whose ") + (query.resident_samples ? "samples" : "summary") +
            (query.resident_samples ? " are" : " is") + " to stay on the device has " +
            number(cells) + " cells, more than the " + number(std::floor(most)) +
            (query.resident_samples
                 ? " that a storage buffer of this device has room for; use a larger tolerance, or "
                   "leave the samples out (resident_samples)"
                 : " that it can count; use a larger tolerance")};
    return false;
}

}  // namespace nearfield::plan
