#include <engine/plan/asked_points.hpp>

#include <limits>
#include <variant>

namespace nearfield::plan {

double reach_of(const PlannedQuery& query) {
    const auto* const contacts = std::get_if<ContactQuery>(query.query);
    return contacts == nullptr ? std::numeric_limits<double>::infinity()
                               : contacts->contact_distance;
}

bool is_left_to_cpu(const PlannedQuery& query, std::size_t edges) {
    // A thread looks at the boxes of all clusters of the lists, for each point.
    constexpr std::size_t few = 1024;
    const bool can_be = std::holds_alternative<PenetrationQuery>(*query.query) ||
                        std::holds_alternative<ContactQuery>(*query.query);
    return can_be && edges > few;
}

}  // namespace nearfield::plan
