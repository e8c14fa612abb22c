#pragma once

#include <engine/device_input/current_query.hpp>
#include <engine/queries/regions.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::device_input {

/// Plans distance fields. Reuses its memory from query to query.
class FieldPlanner {
public:
    /// Adds to the plan, and to the result what is known before rendering. An error is stated in
    /// the result and leaves the query without tiles. Throws StatusException (too_large) if the
    /// batch needs more memory than the limit.
    void plan(const DistanceFieldQuery& query, CurrentQuery& current, DistanceFieldResult& result);

private:
    /// For queries without output at every cell: drops the query's tiles that hold no point.
    void drop_tiles_without_points(std::uint32_t first_tile, const PlannedField& field, Plan& plan);

    queries::Regions regions_;
    std::vector<std::uint32_t> kept_tiles_;
};

}  // namespace nearfield::device_input
