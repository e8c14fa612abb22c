#include <engine/queries/check_query.hpp>
#include <engine/solvers/closest_points.hpp>
#include <engine/solvers/time_of_impact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::solvers {
namespace {

ImpactState state_of(toi::Impact::Kind kind) {
    switch (kind) {
        case toi::Impact::Kind::none:
            return ImpactState::separated;
        case toi::Impact::Kind::found:
            return ImpactState::hit;
        case toi::Impact::Kind::at_start:
            return ImpactState::intersecting_at_start;
        case toi::Impact::Kind::unknown:
            break;
    }
    return ImpactState::bound_not_reached;
}

}  // namespace

void TimeOfImpactSolver::answer(const queries::CheckedQuery& query, Workspace& /*workspace*/,
                                TimeOfImpactResult& result) {
    const auto& asked = std::get<TimeOfImpactQuery>(*query.query);
    const toi::Motion a(*query.a, asked.a.pose, asked.end_a);
    const toi::Motion b(*query.b, asked.b.pose, asked.end_b);
    const double tolerance = asked.tolerance;
    result.status = queries::check_deviations(tolerance, query.deviations, query.budget.bound);
    if (result.status.ok()) {
        result.status =
            queries::check_resolution(tolerance, std::max(a.magnitude(), b.magnitude()));
    }
    if (!result.status.ok()) {
        return;
    }
    // Reduced by the rounding of sums of times up to 1.
    const double time_bound = asked.time_bound - 4.0 * std::numeric_limits<double>::epsilon();
    const toi::Impact contact =
        finder_.find(a, b, {tolerance, time_bound, asked.max_steps, asked.contact_distance});
    result.state = state_of(contact.kind);
    result.intersects = contact.touch_at_latest;
    result.error_bound = contact.rounding + query.deviations.a + query.deviations.b;
    result.time = contact.time;
    result.pose_a = a.at(contact.time);
    result.pose_b = b.at(contact.time);
    result.min_distance = contact.min_distance;
    result.steps = contact.steps;
    if (contact.share_a_point_at_start) {
        result.point_a = result.point_b = geometry::to_public(
            overlap_test_.common_point(finder_.transformed_a(), finder_.transformed_b()));
        return;
    }
    // Rounded up: differences and sums with the time are rounded.
    result.time_error_bound =
        contact.latest > contact.time ? std::nextafter(contact.latest - contact.time, 2.0) : 0.0;
    result.distance = std::sqrt(contact.closest.squared_distance);
    write_closest({*query.a, result.pose_a}, {*query.b, result.pose_b}, contact.closest,
                  result.distance, result);
}

}  // namespace nearfield::solvers
