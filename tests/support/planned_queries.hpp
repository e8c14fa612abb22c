#pragma once

#include <engine/device_input/planner.hpp>
#include <engine/queries/checked_query.hpp>

#include <span>
#include <vector>

namespace nearfield::test {

/// The queries of a batch that pass the check, as they are planned or solved; `results`: of the
/// batch.
inline std::vector<queries::CheckedQuery> checked_queries(
    std::span<const AnyQuery> queries, std::span<const queries::QueryShapes> shapes,
    const queries::QueryLimits& limits, std::vector<AnyResult>& results) {
    std::vector<queries::CheckedQuery> all;
    results.resize(queries.size());
    for (std::uint32_t i = 0; i < queries.size(); ++i) {
        queries::CheckedQuery checked;
        if (queries::check(i, queries[i], shapes[i], limits, checked, results[i])) {
            all.push_back(checked);
        }
    }
    return all;
}

/// Plans a batch of checked queries. `plan_drawn`: if there are any about points of technique
/// raster.
inline void plan_all(std::span<const queries::CheckedQuery> queries,
                     const device_input::PlanDrawnPoints& plan_drawn,
                     device_input::Planner& planner, device_input::Plan& plan,
                     std::vector<AnyResult>& results) {
    planner.begin(results.size(), plan);
    for (const queries::CheckedQuery& query : queries) {
        planner.add(query, plan_drawn, plan, results[query.index]);
    }
    planner.finish(plan);
}

}  // namespace nearfield::test
