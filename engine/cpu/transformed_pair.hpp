#pragma once

#include <engine/localize/hierarchy.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/plan.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <algorithm>
#include <cstdint>

namespace nearfield::cpu {

/// The instances of a query, by their indices in TransformedInstances.
struct InstancePairIndex {
    static constexpr std::uint32_t none = UINT32_MAX;
    std::uint32_t a = none;
    std::uint32_t b = none;
};

/// True if the second query has the same instances as the first in the opposite order.
[[nodiscard]] inline bool is_reverse(const plan::PlannedQuery& first,
                                     const plan::PlannedQuery& second) {
    return first.a == second.b && first.b == second.a && first.pose_a == second.pose_b &&
           first.pose_b == second.pose_a;
}

[[nodiscard]] inline InstancePairIndex place_pair(const plan::PlannedQuery& query,
                                                  simd::TransformedInstances& instances) {
    const std::uint32_t a = instances.place(*query.a, query.pose_a);
    return {a, instances.place(*query.b, query.pose_b)};
}

inline void complete(const InstancePairIndex& pair, simd::TransformedInstances& instances) {
    instances.complete(pair.a);
    instances.complete(pair.b);
}

/// Completes a pair unless both are small, if their boxes intersect: queries then need more than
/// the boxes.
inline void complete_if_near(const InstancePairIndex& pair, simd::TransformedInstances& instances) {
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    if (!(is_small(a) && is_small(b)) && localize::may_meet(a, b)) {
        complete(pair, instances);
    }
}

/// Whether deviations and coordinates permit the tolerance.
[[nodiscard]] inline Status check_numbers(const plan::PlannedQuery& query,
                                          const simd::TransformedEdges& a,
                                          const simd::TransformedEdges& b, double tolerance) {
    if (Status status = plan::check_deviations(tolerance, query.deviations, query.budget.bound);
        !status.ok()) {
        return status;
    }
    return plan::check_resolution(tolerance, std::max(a.magnitude, b.magnitude));
}

}  // namespace nearfield::cpu
