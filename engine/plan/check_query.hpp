#pragma once

#include <engine/geometry/number.hpp>
#include <engine/geometry/placed_polygon.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/technique.hpp>
#include <nearfield/query.hpp>
#include <nearfield/status.hpp>

#include <limits>
#include <string_view>

namespace nearfield::plan {

/// What is wrong with a query's own numbers, or with its technique in a context that has these
/// techniques; or success. Shapes are looked up elsewhere.
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

/// What is said of a query that takes a second submission where there is one command buffer.
[[nodiscard]] Status not_recordable(Technique technique);

/// A pose that can be used, or an error; `whose` it is, for the message.
[[nodiscard]] Status check_pose(const Pose& pose, std::string_view whose);

/// What is wrong with a tolerance that check_resolution() or check_deviations() refuses.
[[nodiscard]] Status unresolved(double tolerance, double largest_magnitude, double smallest);
[[nodiscard]] Status too_deviant(double tolerance, const Deviations& deviations, double bound);

/// A tolerance that double precision can resolve at these coordinates, or an error.
[[nodiscard]] inline Status check_resolution(double tolerance, double largest_magnitude) {
    // Placing a vertex rounds a few times; this leaves that far below a thousandth of d.
    const double smallest = 4096.0 * std::numeric_limits<double>::epsilon() * largest_magnitude;
    return tolerance < smallest ? unresolved(tolerance, largest_magnitude, smallest) : Status();
}

/// Shapes whose deviations leave enough of the tolerance to the query, or an error. `bound`: what
/// the query's budget comes to.
[[nodiscard]] inline Status check_deviations(double tolerance, const Deviations& deviations,
                                             double bound) {
    const double together = deviations.a + deviations.b;
    return together <= most_deviation * tolerance && bound <= tolerance
               ? Status()
               : too_deviant(tolerance, deviations, bound);
}

/// A field whose bound at a distance from B still is within the tolerance, or an error. `bound`:
/// what the budget comes to there.
[[nodiscard]] Status check_distance(double tolerance, double bound, double distance);

using geometry::number;

}  // namespace nearfield::plan
