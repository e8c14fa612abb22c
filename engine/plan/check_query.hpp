#pragma once

#include <engine/geometry/number.hpp>
#include <engine/geometry/placed_polygon.hpp>
#include <engine/plan/error_budget.hpp>
#include <nearfield/query.hpp>
#include <nearfield/status.hpp>

#include <string_view>

namespace nearfield::plan {

/// What is wrong with a query's own numbers, or success. Shapes are looked up elsewhere.
[[nodiscard]] Status check_query(const PenetrationQuery& query);
[[nodiscard]] Status check_query(const IntersectionQuery& query);
[[nodiscard]] Status check_query(const DistanceFieldQuery& query);
[[nodiscard]] Status check_query(const ContactQuery& query);
[[nodiscard]] Status check_query(const ClosestPointQuery& query);
[[nodiscard]] Status check_query(const SeparationQuery& query);
[[nodiscard]] Status check_query(const IntersectionTestQuery& query);

/// A pose that can be used, or an error; `whose` it is, for the message.
[[nodiscard]] Status check_pose(const Pose& pose, std::string_view whose);

/// A tolerance that double precision can resolve at these coordinates, or an error.
[[nodiscard]] Status check_resolution(double tolerance, double largest_magnitude);

/// Shapes whose deviations leave enough of the tolerance to the query, or an error. `bound`: what
/// the query's budget comes to.
[[nodiscard]] Status check_deviations(double tolerance, const Deviations& deviations, double bound);

using geometry::number;

}  // namespace nearfield::plan
