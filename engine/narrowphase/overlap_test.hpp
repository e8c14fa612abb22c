#pragma once

#include <engine/narrowphase/candidate_edge_pairs.hpp>
#include <engine/simd/transformed_edges.hpp>

namespace nearfield::narrowphase {

/// Tests whether two closed shapes share a point: their boundaries intersect (touching counts, and
/// so does a gap within the rounding of the transformed vertices), or one shape contains the other.
/// Uses brute force for two small shapes and AABB trees otherwise. Precondition: unless both are
/// small, both are complete if their boxes intersect. Reuses its memory between pairs.
class OverlapTest {
public:
    [[nodiscard]] bool intersect(const simd::TransformedEdges& a, const simd::TransformedEdges& b);

    /// The same for shapes where no vertex of A is inside B, which is faster.
    [[nodiscard]] bool intersect_without_vertex_inside(const simd::TransformedEdges& a,
                                                       const simd::TransformedEdges& b);

    /// True if the boundaries intersect; `edges` is then a pair that does. Otherwise `edges` is
    /// unspecified.
    [[nodiscard]] bool boundaries_meet(const simd::TransformedEdges& a,
                                       const simd::TransformedEdges& b, simd::EdgePair& edges);
    /// A point of two complete shapes that are known to share one, up to rounding.
    [[nodiscard]] geometry::Vector common_point(const simd::TransformedEdges& a,
                                                const simd::TransformedEdges& b);

private:
    CandidateEdgePairs pairs_;
};

}  // namespace nearfield::narrowphase
