#pragma once

#include <engine/geometry/hierarchy.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/checked_query.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <algorithm>
#include <cstdint>

namespace nearfield::queries {

/// The shapes of a query in their places, by their indices in TransformedInstances.
struct PlacedPair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
};

[[nodiscard]] inline PlacedPair place_pair(const ShapePair& shapes,
                                           simd::TransformedInstances& instances) {
    const std::uint32_t a = instances.place(*shapes.a, shapes.pose_a);
    return {a, instances.place(*shapes.b, shapes.pose_b)};
}

inline void complete(const PlacedPair& pair, simd::TransformedInstances& instances) {
    instances.complete(pair.a);
    instances.complete(pair.b);
}

inline void prepare(const PlacedPair& pair, simd::TransformedInstances& instances) {
    instances.prepare(pair.a);
    instances.prepare(pair.b);
}

/// Whether queries need more of a pair than its boxes and, if both are small, its edges.
[[nodiscard]] inline bool needs_trees(const PlacedPair& pair,
                                      const simd::TransformedInstances& instances) {
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    return !(is_small(a) && is_small(b)) && geometry::may_meet(a, b);
}

inline void complete_if_near(const PlacedPair& pair, simd::TransformedInstances& instances) {
    if (needs_trees(pair, instances)) {
        complete(pair, instances);
    }
}

/// Whether the shapes share a point.
[[nodiscard]] inline bool intersect(const PlacedPair& pair, simd::TransformedInstances& instances,
                                    narrowphase::OverlapTest& overlap_test) {
    if (needs_trees(pair, instances)) {
        prepare(pair, instances);
    }
    return overlap_test.intersect(instances[pair.a], instances[pair.b]);
}
[[nodiscard]] inline bool intersect(const ShapePair& shapes, simd::TransformedInstances& instances,
                                    narrowphase::OverlapTest& overlap_test) {
    return intersect(place_pair(shapes, instances), instances, overlap_test);
}

/// Whether deviations and coordinates permit the tolerance.
[[nodiscard]] inline Status check_numbers(const CheckedQuery& query,
                                          const simd::TransformedEdges& a,
                                          const simd::TransformedEdges& b, double tolerance) {
    if (Status status = check_deviations(tolerance, query.deviations, query.budget.bound);
        !status.ok()) {
        return status;
    }
    return check_resolution(tolerance, std::max(a.magnitude, b.magnitude));
}

}  // namespace nearfield::queries
