#pragma once

#include <engine/base/stopwatch.hpp>
#include <engine/geometry/recently_placed.hpp>
#include <engine/localize/overlap.hpp>
#include <engine/plan/memory_budget.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/plan_limits.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// The query that is being planned.
struct CurrentQuery {
    const PlanLimits& limits;
    Plan& plan;
    std::uint32_t index;  ///< in Plan::queries
    QueryMemory memory;

    [[nodiscard]] PlannedQuery& planned() const { return plan.queries[index]; }
    [[nodiscard]] localize::OverlapOptions overlap_options(double grow) const {
        return {limits.hierarchy_height, grow, limits.bounding_volume};
    }
};

/// Adds what a search of hierarchies found, and took, to the statistics of a result.
inline void count_chains(const localize::Effort& effort, const std::vector<localize::Chain>& chains,
                         ResultSummary& result) {
    result.localization.nodes_evaluated += effort.nodes_evaluated;
    result.localization.pairs_rejected += effort.pairs_rejected;
    for (const localize::Chain& chain : chains) {
        result.localization.edges_kept += chain.count;
    }
}

/// Replaces `chains` by those that a search of hierarchies appends to them; adds what it took to
/// the statistics. `search` returns its effort.
template <class Search>
void find_chains(Plan& plan, ResultSummary& result, std::vector<localize::Chain>& chains,
                 Search&& search) {
    const Stopwatch start;
    chains.clear();
    count_chains(search(), chains, result);
    plan.localize_milliseconds += start.milliseconds();
}

/// Checks that deviations and coordinates of a query about points are compatible with the
/// tolerance; the result states the error.
[[nodiscard]] bool check_numbers(const PlannedQuery& planned, const geometry::BoxedPolygon& a,
                                 const geometry::BoxedPolygon& b, ResultSummary& result);

/// Adds the other direction of the query: points of B in the field of A.
[[nodiscard]] std::uint32_t add_reverse(CurrentQuery& current);

}  // namespace nearfield::plan
