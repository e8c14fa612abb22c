#pragma once

#include <engine/base/stopwatch.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/geometry/overlap.hpp>
#include <engine/geometry/recently_placed.hpp>
#include <engine/queries/memory_budget.hpp>
#include <engine/queries/query_limits.hpp>
#include <engine/queries/regions.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::device_input {

/// The query that is being planned.
struct CurrentQuery {
    const queries::QueryLimits& limits;
    Plan& plan;
    std::uint32_t index;  ///< in Plan::queries
    queries::QueryMemory memory;

    [[nodiscard]] PlannedQuery& planned() const { return plan.queries[index]; }
    [[nodiscard]] geometry::OverlapOptions overlap_options(double grow) const {
        return {limits.hierarchy_height, grow, limits.bounding_volume};
    }
};

/// Replaces `chains` by those that a search of hierarchies appends to them; adds what it took to
/// the statistics. `search` returns its effort.
template <class Search>
void find_chains(Plan& plan, ResultSummary& result, std::vector<geometry::Chain>& chains,
                 Search&& search) {
    const Stopwatch start;
    chains.clear();
    queries::count_chains(search(), chains, result);
    plan.localize_milliseconds += start.milliseconds();
}

/// Checks that deviations and coordinates of a query about points are compatible with the
/// tolerance; the result states the error.
[[nodiscard]] bool check_numbers(const PlannedQuery& planned, const geometry::BoxedPolygon& a,
                                 const geometry::BoxedPolygon& b, ResultSummary& result);

/// Adds the other direction of the query: points of B in the field of A.
[[nodiscard]] std::uint32_t add_reverse(CurrentQuery& current);

/// Adds tiles of at most `side` x `side` cells, each with a halo around it, that cover the regions
/// of the query.
void add_tiles(const queries::Regions& regions, TileKind kind, std::uint32_t side,
               std::uint32_t halo, CurrentQuery& current);

}  // namespace nearfield::device_input
