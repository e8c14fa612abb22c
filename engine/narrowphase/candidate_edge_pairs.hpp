#pragma once

#include <engine/simd/edge_subset.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <vector>

namespace nearfield::narrowphase {

/// Finds the pairs of edges of two transformed polygons that may intersect: by brute force for two
/// small polygons, by AABB trees otherwise. Reuses its memory between pairs.
class CandidateEdgePairs {
public:
    /// Calls `use` with an EdgePair for every pair of an edge of A and an edge of B that are closer
    /// than the vertices' rounding, and for hardly any other, until it returns false; returns
    /// whether it did. In ascending order if both are small. Precondition: unless both are small,
    /// both are complete.
    template <class Use>
    bool for_each(const simd::TransformedEdges& a, const simd::TransformedEdges& b, Use&& use) {
        return is_small(a) && is_small(b) ? for_each_of_small(a, b, use)
                                          : for_each_by_boxes(a, b, use);
    }

    /// Lists the same pairs. Returns false, and an incomplete list, if that takes several times
    /// what trees take that divide the edges well.
    [[nodiscard]] bool find_all(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                std::vector<simd::EdgePair>& pairs);

private:
    template <class Use>
    bool for_each_of_small(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                           Use& use) {
        const double margin = a.rounding + b.rounding;
        if (!pick_near(a, b, 2.0 * margin)) {
            return false;
        }
        const simd::EdgeArrays picked_a = of_a_.edges();
        const simd::EdgeArrays all_of_b = b;
        const simd::EdgeArrays others = of_b_.empty() ? all_of_b : of_b_.edges();
        simd::EdgePair pair;
        while (simd::kernels::find_intersecting_pair(picked_a, others, margin, pair)) {
            const std::uint32_t other = of_b_.empty() ? pair.second : of_b_.index(pair.second);
            if (!use(simd::EdgePair{of_a_.index(pair.first), other})) {
                return true;
            }
            ++pair.second;
        }
        return false;
    }

    template <class Use>
    static bool for_each_by_boxes(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                  Use& use) {
        simd::VisitsLeft unlimited;
        return simd::kernels::for_candidate_pairs(a.tree(), b.tree(), a.rounding + b.rounding, use,
                                                  unlimited);
    }

    /// Selects the edges of A, and if they are several those of B, that lie in both boxes, grown by
    /// `grow`; false if either selection is empty.
    [[nodiscard]] bool pick_near(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                 double grow);

    simd::EdgeSubset of_a_;
    simd::EdgeSubset of_b_;
};

}  // namespace nearfield::narrowphase
