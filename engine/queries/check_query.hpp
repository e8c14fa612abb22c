#pragma once

#include <engine/geometry/number.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/queries/technique.hpp>
#include <nearfield/query.hpp>
#include <nearfield/status.hpp>

#include <limits>
#include <string_view>

namespace nearfield::queries {

/// The numbers that every query has, and what its technique leaves unanswered.
struct CommonNumbers {
    Technique technique{};
    const char* unanswered = nullptr;         ///< by the technique, see unanswered()
    const char* unanswered_by_cpu = nullptr;  ///< for Technique::automatic
    const double* tolerance = nullptr;        ///< null for a query without one
    const Pose& a;
    const Pose& b;
};
[[nodiscard]] Status check_common(const CommonNumbers& numbers,
                                  const AvailableTechniques& available);

/// Checks the numbers of its own that a kind of query has.
[[nodiscard]] Status check_own(const PenetrationQuery& query);
[[nodiscard]] Status check_own(const IntersectionQuery& query);
[[nodiscard]] Status check_own(const DistanceFieldQuery& query);
[[nodiscard]] Status check_own(const ContactQuery& query);
[[nodiscard]] Status check_own(const TimeOfImpactQuery& query);
/// Other kinds have none.
template <class Query>
[[nodiscard]] Status check_own(const Query& /*query*/) {
    return {};
}

/// Checks a query's numbers, and its technique against those available in the context. Returns
/// success or the first error. Shapes are looked up elsewhere.
template <class Query>
[[nodiscard]] Status check_query(const Query& query, const AvailableTechniques& available) {
    const double* tolerance = nullptr;
    if constexpr (requires { query.tolerance; }) {
        tolerance = &query.tolerance;
    }
    Status status =
        check_common({query.technique, unanswered(query.technique, query),
                      unanswered(Technique::cpu, query), tolerance, query.a.pose, query.b.pose},
                     available);
    return status.ok() ? check_own(query) : status;
}

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

}  // namespace nearfield::queries
