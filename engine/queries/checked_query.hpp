#pragma once

#include <engine/queries/error_budget.hpp>
#include <engine/queries/query_limits.hpp>
#include <engine/queries/query_shapes.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

#include <cstdint>

namespace nearfield::queries {

/// Two shapes at their poses.
struct ShapePair {
    const geometry::Polygon* a = nullptr;  ///< null for a distance field without a shape A
    const geometry::Polygon* b = nullptr;
    Pose pose_a;
    Pose pose_b;
};

/// True if the second pair is the first in the opposite order.
[[nodiscard]] inline bool is_reverse(const ShapePair& first, const ShapePair& second) {
    return first.a == second.b && first.b == second.a && first.pose_a == second.pose_b &&
           first.pose_b == second.pose_a;
}

/// A query whose numbers have been checked and whose shapes exist. Constant after the check. The
/// query and the polygons must stay until it is answered.
struct CheckedQuery : ShapePair {
    std::uint32_t index = 0;  ///< in its batch
    const AnyQuery* query = nullptr;
    Deviations deviations;  ///< of both shapes
    ErrorBudget budget;
    Technique technique{};  ///< that answers: cpu also for what compute leaves to it
};

/// Checks a query of a batch. Returns true and fills in `checked`, or returns false and states the
/// error in the result. The result is emptied first; it then states what is known of every query:
/// tolerance, technique, bound and cell.
[[nodiscard]] bool check(std::uint32_t index, const AnyQuery& any, const QueryShapes& shapes,
                         const QueryLimits& limits, CheckedQuery& checked, AnyResult& result);

/// Upper bound on the points of A's boundary that a penetration or contact query, or one direction
/// of it, examines at any poses. A double, since it may be huge.
[[nodiscard]] double max_points(const CheckedQuery& query);

/// Points of A's boundary at most, of a query or a pair, that a device searches.
inline constexpr double max_searched_points = 1U << 21U;
/// Upper bound on the bytes of a shape on a device, for whatever use.
[[nodiscard]] std::uint64_t max_shape_bytes(const geometry::Polygon& polygon);
/// The same for two shapes, which may be one.
[[nodiscard]] inline std::uint64_t max_shape_bytes(const geometry::Polygon& a,
                                                   const geometry::Polygon& b) {
    return max_shape_bytes(a) + (&a != &b ? max_shape_bytes(b) : 0);
}

}  // namespace nearfield::queries
