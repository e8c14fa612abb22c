#pragma once

#include <engine/geometry/number.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/technique.hpp>
#include <nearfield/query.hpp>
#include <nearfield/status.hpp>

#include <limits>
#include <string_view>

namespace nearfield::plan {

/// Checks a query's own numbers, and its technique against those available in the context. Returns
/// success or the first error. Shapes are looked up elsewhere.
[[nodiscard]] Status check_query(const PenetrationQuery& query,
                                 const AvailableTechniques& available);
[[nodiscard]] Status check_query(const IntersectionQuery& query,
                                 const AvailableTechniques& available);
[[nodiscard]] Status check_query(const DistanceFieldQuery& query,
                                 const AvailableTechniques& available);
[[nodiscard]] Status check_query(const ContactQuery& query, const AvailableTechniques& available);
[[nodiscard]] Status check_query(const ClosestPointQuery& query,
                                 const AvailableTechniques& available);
[[nodiscard]] Status check_query(const SeparationQuery& query,
                                 const AvailableTechniques& available);
[[nodiscard]] Status check_query(const IntersectionTestQuery& query,
                                 const AvailableTechniques& available);
[[nodiscard]] Status check_query(const TimeOfImpactQuery& query,
                                 const AvailableTechniques& available);
[[nodiscard]] Status check_query(const SeparationVectorQuery& query,
                                 const AvailableTechniques& available);
[[nodiscard]] Status check_query(const ContainmentQuery& query,
                                 const AvailableTechniques& available);

/// The error for a query that needs a second submission when there is only one command buffer.
[[nodiscard]] Status not_recordable(Technique technique);

/// Checks that a pose is usable; `whose` names its owner in the message.
[[nodiscard]] Status check_pose(const Pose& pose, std::string_view whose);

/// The errors for a tolerance that check_resolution() or check_deviations() rejects.
[[nodiscard]] Status unresolved(double tolerance, double largest_magnitude, double smallest);
[[nodiscard]] Status too_deviant(double tolerance, const Deviations& deviations, double bound);

/// The smallest tolerance that double precision can resolve at these coordinates.
[[nodiscard]] constexpr double smallest_tolerance(double largest_magnitude) {
    // Transforming a vertex rounds a few times; this keeps that far below a thousandth of d.
    return 4096.0 * std::numeric_limits<double>::epsilon() * largest_magnitude;
}

/// Checks that double precision can resolve the tolerance at these coordinates.
[[nodiscard]] inline Status check_resolution(double tolerance, double largest_magnitude) {
    const double smallest = smallest_tolerance(largest_magnitude);
    return tolerance < smallest ? unresolved(tolerance, largest_magnitude, smallest) : Status();
}

/// Checks that the shapes' deviations leave enough of the tolerance to the query. `bound`: the
/// error bound of the query's budget.
[[nodiscard]] inline Status check_deviations(double tolerance, const Deviations& deviations,
                                             double bound) {
    const double together = deviations.a + deviations.b;
    return together <= max_deviation * tolerance && bound <= tolerance
               ? Status()
               : too_deviant(tolerance, deviations, bound);
}

/// Checks that a field's error bound at this distance from B is still within the tolerance.
/// `bound`: the budget's bound there.
[[nodiscard]] Status check_distance(double tolerance, double bound, double distance);

using geometry::number;

}  // namespace nearfield::plan
