#pragma once

#include <engine/plan/error_budget.hpp>
#include <nearfield/query.hpp>

#include <cstddef>
#include <cstdint>

namespace nearfield::plan {

/// What the device finds out about the pairs of a world's instances.
enum class PairGoal : std::uint8_t {
    penetrations,  ///< the points of either shape inside the other, for ordered pairs
    tests,         ///< whether the shapes intersect, once for each pair
};

inline constexpr std::size_t pair_goals = 2;

/// What a query asks of the device about every pair of a world's instances. World units.
struct PairQuestion {
    PairGoal goal{};
    double tolerance = 0.0;  ///< of tests: 0, there is none
    double cell = 0.0;       ///< the side of a grid cell
    bool samples = false;    ///< along the edges, not only vertices
    bool records = false;    ///< the host reads the points that are found
};

/// Precondition: the query is one that the device answers for all pairs of a world.
[[nodiscard]] PairQuestion pair_question(const AnyQuery& query);
/// How such a query, which has a tolerance, spends it on shapes with these deviations.
[[nodiscard]] ErrorBudget pair_budget(const AnyQuery& query, const Deviations& deviations);

}  // namespace nearfield::plan
