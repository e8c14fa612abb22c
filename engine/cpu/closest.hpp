#pragma once

#include <engine/cpu/common_point.hpp>
#include <engine/narrowphase/closest_pair.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/plan/plan.hpp>
#include <nearfield/result.hpp>

#include <shaders/layout.h>

#include <cstdint>
#include <span>

namespace nearfield::cpu {

/// Decodes closest points and separations: the rendered samples give an upper bound, and an exact
/// search below it finds the answer.
class ClosestDecoder {
public:
    /// `words`: by point of the plan. The result already says whether the shapes intersect.
    void decode(const plan::Plan& plan, const plan::PlannedQuery& query,
                std::span<const std::uint32_t> words, simd::TransformedInstances& instances,
                ClosestPointResult& result);
    void decode(const plan::Plan& plan, const plan::PlannedQuery& query,
                std::span<const std::uint32_t> words, simd::TransformedInstances& instances,
                SeparationResult& result);

private:
    /// Technique::cpu: computes everything from the shapes themselves.
    void answer(const plan::PlannedQuery& query, simd::TransformedInstances& instances,
                SeparationResult& result);
    /// Precondition: complete, separate shapes. `at_most`: a known upper bound on their distance.
    void answer_apart(const plan::PlannedQuery& query, const simd::TransformedEdges& a,
                      const simd::TransformedEdges& b, double at_most, SeparationResult& result);

    narrowphase::ClosestPairFinder finder_;
    narrowphase::OverlapTest overlap_test_;
    CommonPoint common_point_;
};

}  // namespace nearfield::cpu
