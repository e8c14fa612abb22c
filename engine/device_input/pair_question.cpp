#include <engine/device_input/pair_question.hpp>

#include <variant>

namespace nearfield::device_input {

namespace {

template <class Query>
PairQuestion near_question(const Query& query, double reach) {
    return {.goal = PairGoal::tests,
            .resolved = query.tolerance,
            .reach = reach,
            .is_once = is_symmetric<Query>};
}

}  // namespace

bool is_for_all_pairs(const AnyQuery& query) {
    const auto* const contacts = std::get_if<ContactQuery>(&query);
    return std::holds_alternative<PenetrationQuery>(query) ||
           std::holds_alternative<IntersectionTestQuery>(query) ||
           std::holds_alternative<SeparationQuery>(query) ||
           std::holds_alternative<ClosestPointQuery>(query) ||
           (contacts != nullptr && contacts->normals == ContactNormals::analytic);
}

PairQuestion pair_question(const AnyQuery& query, double reach) {
    if (std::holds_alternative<IntersectionTestQuery>(query)) {
        return {.goal = PairGoal::tests, .is_once = is_symmetric<IntersectionTestQuery>};
    }
    if (const auto* const separation = std::get_if<SeparationQuery>(&query)) {
        return near_question(*separation, reach);
    }
    if (const auto* const closest = std::get_if<ClosestPointQuery>(&query)) {
        return near_question(*closest, reach);
    }
    if (const auto* const contacts = std::get_if<ContactQuery>(&query)) {
        return {.goal = PairGoal::contacts,
                .tolerance = contacts->tolerance,
                .resolved = contacts->tolerance,
                .cell = queries::contact_budget(contacts->tolerance, {}).cell,
                .samples = true,
                .records = !contacts->summary_only,
                .reach = contacts->contact_distance,
                .on_device = contacts->on_device};
    }
    const auto& penetration = std::get<PenetrationQuery>(query);
    return {.goal = PairGoal::penetrations,
            .tolerance = penetration.tolerance,
            .resolved = penetration.tolerance,
            .cell = queries::penetration_budget(penetration).cell,
            .samples = penetration.points == PenetrationPoints::boundary,
            .records = !penetration.summary_only,
            .on_device = penetration.on_device};
}

queries::ErrorBudget pair_budget(const AnyQuery& query, const queries::Deviations& deviations) {
    if (const auto* const contacts = std::get_if<ContactQuery>(&query)) {
        return queries::contact_budget(contacts->tolerance, deviations);
    }
    return queries::penetration_budget(std::get<PenetrationQuery>(query), deviations);
}

}  // namespace nearfield::device_input
