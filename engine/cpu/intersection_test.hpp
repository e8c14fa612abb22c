#pragma once

#include <engine/cpu/transformed_pair.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <nearfield/result.hpp>

namespace nearfield::cpu {

/// Answers intersection tests, from query to result. Reuses its memory between batches.
class IntersectionTest {
public:
    /// Whether the shapes of any query share a point.
    [[nodiscard]] bool intersect(const plan::PlannedQuery& query,
                                 simd::TransformedInstances& instances);
    /// The same for instances in their places.
    [[nodiscard]] bool intersect(const InstancePairIndex& pair,
                                 simd::TransformedInstances& instances);
    /// Writes a result whose status is good.
    void answer(const plan::PlannedQuery& query, simd::TransformedInstances& instances,
                IntersectionTestResult& result);

private:
    narrowphase::OverlapTest overlap_test_;
};

}  // namespace nearfield::cpu
