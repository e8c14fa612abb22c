#include <engine/cpu/time_of_impact.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/records/nearest_feature.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::cpu {
namespace {

using narrowphase::ClosestPair;
using toi::Impact;
using toi::Motion;

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

void write_closest(const plan::PlannedQuery& planned, const narrowphase::ClosestPair& closest,
                   TimeOfImpactResult& result) {
    const geometry::TransformedPolygon a(*planned.a, result.pose_a);
    const geometry::TransformedPolygon b(*planned.b, result.pose_b);
    result.distance = std::sqrt(closest.squared_distance);
    result.point_a = geometry::to_public(closest.point_a);
    result.point_b = geometry::to_public(closest.point_b);
    if (result.distance > 0.0) {
        result.direction =
            geometry::to_public((closest.point_b - closest.point_a) / result.distance);
    }
    result.feature_a = records::feature_at(a, closest.edge_a, closest.parameter_a);
    result.feature_b = records::feature_at(b, closest.edge_b, closest.parameter_b);
}

}  // namespace

void TimeOfImpact::answer(const plan::PlannedQuery& planned, TimeOfImpactResult& result) {
    const auto& query = std::get<TimeOfImpactQuery>(*planned.query);
    const toi::Motion a(*planned.a, query.a.pose, query.end_a);
    const toi::Motion b(*planned.b, query.b.pose, query.end_b);
    const double tolerance = query.tolerance;
    result.status = plan::check_deviations(tolerance, planned.deviations, planned.budget.bound);
    if (result.status.ok()) {
        result.status = plan::check_resolution(tolerance, std::max(a.magnitude(), b.magnitude()));
    }
    if (!result.status.ok()) {
        return;
    }
    // Reduced by the rounding of sums of times up to 1.
    const double time_bound = query.time_bound - 4.0 * std::numeric_limits<double>::epsilon();
    const toi::Impact contact =
        finder_.find(a, b, {tolerance, time_bound, query.max_steps, query.contact_distance});
    result.state = state_of(contact.kind);
    result.intersects = contact.touch_at_latest;
    result.error_bound = contact.rounding + planned.deviations.a + planned.deviations.b;
    result.time = contact.time;
    result.pose_a = a.at(contact.time);
    result.pose_b = b.at(contact.time);
    result.min_distance = contact.min_distance;
    result.steps = contact.steps;
    if (contact.share_a_point_at_start) {
        result.point_a = result.point_b = geometry::to_public(
            common_point_.find(finder_.transformed_a(), finder_.transformed_b()));
        return;
    }
    // Rounded up: differences and sums with the time are rounded.
    result.time_error_bound =
        contact.latest > contact.time ? std::nextafter(contact.latest - contact.time, 2.0) : 0.0;
    write_closest(planned, contact.closest, result);
}

}  // namespace nearfield::cpu
