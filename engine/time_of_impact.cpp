#include <engine/nearest_feature.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/time_of_impact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield {
namespace {

using exact::ClosestPair;
using exact::FirstContact;
using exact::Motion;

ImpactState state_of(FirstContact::Kind kind) {
    switch (kind) {
        case FirstContact::Kind::none:
            return ImpactState::separated;
        case FirstContact::Kind::found:
            return ImpactState::hit;
        case FirstContact::Kind::at_start:
            return ImpactState::intersecting_at_start;
        case FirstContact::Kind::unknown:
            break;
    }
    return ImpactState::bound_not_reached;
}

void write_closest(const plan::PlannedQuery& planned, const ClosestPair& closest,
                   TimeOfImpactResult& result) {
    const geometry::PlacedPolygon a(*planned.a, result.pose_a);
    const geometry::PlacedPolygon b(*planned.b, result.pose_b);
    result.distance = std::sqrt(closest.squared_distance);
    result.point_a = geometry::to_public(closest.point_a);
    result.point_b = geometry::to_public(closest.point_b);
    if (result.distance > 0.0) {
        result.direction =
            geometry::to_public((closest.point_b - closest.point_a) / result.distance);
    }
    result.feature_a = feature_at(a, closest.edge_a, closest.parameter_a);
    result.feature_b = feature_at(b, closest.edge_b, closest.parameter_b);
}

}  // namespace

void TimeOfImpact::answer(const plan::PlannedQuery& planned, TimeOfImpactResult& result) {
    const auto& query = std::get<TimeOfImpactQuery>(*planned.query);
    const Motion a(*planned.a, query.a.pose, query.end_a);
    const Motion b(*planned.b, query.b.pose, query.end_b);
    const double tolerance = query.tolerance;
    result.status = plan::check_deviations(tolerance, planned.deviations, planned.budget.bound);
    if (result.status.ok()) {
        result.status = plan::check_resolution(tolerance, std::max(a.magnitude(), b.magnitude()));
    }
    if (!result.status.ok()) {
        return;
    }
    // Less by what sums with times up to 1 round.
    const double time_bound = query.time_bound - 4.0 * std::numeric_limits<double>::epsilon();
    const FirstContact contact =
        finder_.find(a, b, {tolerance, time_bound, query.most_steps, query.contact_distance});
    result.state = state_of(contact.kind);
    result.intersects = contact.touch_at_latest;
    result.error_bound = contact.rounding + planned.deviations.a + planned.deviations.b;
    result.time = contact.time;
    result.pose_a = a.at(contact.time);
    result.pose_b = b.at(contact.time);
    result.least_distance = contact.least_distance;
    result.steps = contact.steps;
    if (contact.share_a_point_at_start) {
        result.point_a = result.point_b =
            geometry::to_public(common_point_.find(finder_.placed_a(), finder_.placed_b()));
        return;
    }
    // No less than what was left open: differences and sums with the time round.
    result.time_error_bound =
        contact.latest > contact.time ? std::nextafter(contact.latest - contact.time, 2.0) : 0.0;
    write_closest(planned, contact.closest, result);
}

}  // namespace nearfield
