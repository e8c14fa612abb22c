#include <engine/plan/pair_question.hpp>

#include <variant>

namespace nearfield::plan {

PairQuestion pair_question(const AnyQuery& query, double reach) {
    if (std::holds_alternative<IntersectionTestQuery>(query)) {
        return {.goal = PairGoal::tests, .is_once = true};
    }
    if (std::holds_alternative<SeparationQuery>(query) ||
        std::holds_alternative<ClosestPointQuery>(query)) {
        return {.goal = PairGoal::tests,
                .reach = reach,
                .is_once = std::holds_alternative<SeparationQuery>(query)};
    }
    if (const auto* const contacts = std::get_if<ContactQuery>(&query)) {
        return {PairGoal::contacts,
                contacts->tolerance,
                contact_budget(contacts->tolerance, {}).cell,
                true,
                contacts->records,
                contacts->contact_distance,
                false,
                contacts->resident};
    }
    const auto& penetration = std::get<PenetrationQuery>(query);
    return {PairGoal::penetrations,
            penetration.tolerance,
            penetration_budget(penetration).cell,
            penetration.points == PenetrationPoints::boundary,
            penetration.records,
            0.0,
            false,
            penetration.resident};
}

ErrorBudget pair_budget(const AnyQuery& query, const Deviations& deviations) {
    if (const auto* const contacts = std::get_if<ContactQuery>(&query)) {
        return contact_budget(contacts->tolerance, deviations);
    }
    return penetration_budget(std::get<PenetrationQuery>(query), deviations);
}

}  // namespace nearfield::plan
