#pragma once

#include <engine/device_input/planner.hpp>

#include <tests/support/checked_queries.hpp>

#include <span>
#include <vector>

namespace nearfield::test {

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
