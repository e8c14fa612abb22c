#pragma once

#include <engine/plan/checked_query.hpp>
#include <engine/plan/planner.hpp>

#include <span>
#include <vector>

namespace nearfield::test {

/// The queries of a batch that pass the check, as they are planned or solved; `results`: of the
/// batch.
inline std::vector<plan::CheckedQuery> checked_queries(std::span<const AnyQuery> queries,
                                                       std::span<const plan::QueryShapes> shapes,
                                                       const plan::PlanLimits& limits,
                                                       std::vector<AnyResult>& results) {
    std::vector<plan::CheckedQuery> all;
    results.resize(queries.size());
    for (std::uint32_t i = 0; i < queries.size(); ++i) {
        plan::CheckedQuery checked;
        if (plan::check(i, queries[i], shapes[i], limits, plan::Submissions::any, checked,
                        results[i])) {
            all.push_back(checked);
        }
    }
    return all;
}

/// Plans a batch of such queries. `plan_drawn`: if there are any about points of technique raster.
inline void plan_all(std::span<const plan::CheckedQuery> queries,
                     const plan::PlanDrawnPoints& plan_drawn, plan::Planner& planner,
                     plan::Plan& plan, std::vector<AnyResult>& results) {
    planner.begin(results.size(), plan);
    for (const plan::CheckedQuery& query : queries) {
        planner.add(query, plan_drawn, plan, results[query.index]);
    }
    planner.finish(plan);
}

}  // namespace nearfield::test
