#pragma once

#include <engine/cpu/transformed_pair.hpp>
#include <engine/narrowphase/closest_pair.hpp>
#include <engine/narrowphase/containment_test.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <nearfield/result.hpp>

namespace nearfield::cpu {

/// Answers containment queries, from query to result. Reuses its memory between batches.
class Containment {
public:
    /// Writes a result whose status is good.
    void answer(const plan::PlannedQuery& query, simd::TransformedInstances& instances,
                ContainmentResult& result);

private:
    /// Precondition: complete shapes, A inside B.
    void write_clearance(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                         ContainmentResult& result);

    narrowphase::ContainmentTest containment_test_;
    narrowphase::OverlapTest overlap_test_;
    narrowphase::ClosestPairFinder finder_;
};

}  // namespace nearfield::cpu
