#pragma once

#include <engine/device_input/current_query.hpp>
#include <engine/queries/overlap_regions.hpp>
#include <nearfield/result.hpp>

namespace nearfield::device_input {

/// Plans intersections for a device. Reuses its memory from query to query.
class OverlapPlanner {
public:
    /// Adds to the plan, and to the result what is known before rendering. An error is stated in
    /// the result and leaves the query without tiles. Throws StatusException (too_large) if the
    /// batch needs more memory than the limit.
    void plan(const IntersectionQuery& query, CurrentQuery& current, IntersectionResult& result);

private:
    queries::OverlapRegions overlaps_;
};

}  // namespace nearfield::device_input
