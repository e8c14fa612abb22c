#pragma once

#include <engine/narrowphase/overlap_test.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

namespace nearfield::solvers {

/// Answers intersection tests. Reuses its memory between batches.
class IntersectionTestSolver {
public:
    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                IntersectionTestResult& result);

private:
    narrowphase::OverlapTest overlap_test_;
};

}  // namespace nearfield::solvers
