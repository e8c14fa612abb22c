#pragma once

#include <engine/plan/error_budget.hpp>
#include <nearfield/query.hpp>

namespace nearfield::plan {

/// What a query asks of the device about every pair of a world's instances. World units.
struct PairQuestion {
    double tolerance = 0.0;
    double cell = 0.0;     ///< the side of a grid cell
    bool samples = false;  ///< along the edges, not only vertices
    bool records = false;  ///< the host reads the points that are found
};

/// Precondition: the query is one that the device answers for all pairs of a world.
[[nodiscard]] PairQuestion pair_question(const AnyQuery& query);
/// How such a query spends its tolerance on shapes with these deviations.
[[nodiscard]] ErrorBudget pair_budget(const AnyQuery& query, const Deviations& deviations);

}  // namespace nearfield::plan
