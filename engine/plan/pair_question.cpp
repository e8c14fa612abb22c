#include <engine/plan/pair_question.hpp>

#include <variant>

namespace nearfield::plan {

PairQuestion pair_question(const AnyQuery& query) {
    if (std::holds_alternative<IntersectionTestQuery>(query)) {
        return {.goal = PairGoal::tests};
    }
    const auto& penetration = std::get<PenetrationQuery>(query);
    return {PairGoal::penetrations, penetration.tolerance, penetration_budget(penetration).cell,
            penetration.points == PenetrationPoints::boundary, penetration.records};
}

ErrorBudget pair_budget(const AnyQuery& query, const Deviations& deviations) {
    return penetration_budget(std::get<PenetrationQuery>(query), deviations);
}

}  // namespace nearfield::plan
