#include <engine/plan/pair_question.hpp>

#include <variant>

namespace nearfield::plan {

PairQuestion pair_question(const AnyQuery& query) {
    const auto& penetration = std::get<PenetrationQuery>(query);
    return {penetration.tolerance, penetration_budget(penetration).cell,
            penetration.points == PenetrationPoints::boundary, penetration.records};
}

ErrorBudget pair_budget(const AnyQuery& query, const Deviations& deviations) {
    return penetration_budget(std::get<PenetrationQuery>(query), deviations);
}

}  // namespace nearfield::plan
