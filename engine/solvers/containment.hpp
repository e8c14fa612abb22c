#pragma once

#include <engine/narrowphase/closest_pair.hpp>
#include <engine/narrowphase/containment_test.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

namespace nearfield::solvers {

/// Answers containment queries. Reuses its memory between batches.
class ContainmentSolver {
public:
    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                ContainmentResult& result);

private:
    /// Precondition: complete shapes, A inside B.
    void write_clearance(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                         ContainmentResult& result);

    narrowphase::ContainmentTest containment_test_;
    narrowphase::OverlapTest overlap_test_;
    narrowphase::ClosestPairFinder finder_;
};

}  // namespace nearfield::solvers
