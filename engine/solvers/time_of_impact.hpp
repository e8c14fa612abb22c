#pragma once

#include <engine/narrowphase/overlap_test.hpp>
#include <engine/solvers/workspace.hpp>
#include <engine/toi/conservative_advancement.hpp>
#include <nearfield/result.hpp>

namespace nearfield::solvers {

/// Answers time-of-impact queries. Reuses its memory between batches.
class TimeOfImpactSolver {
public:
    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                TimeOfImpactResult& result);

private:
    toi::ConservativeAdvancement finder_;
    narrowphase::OverlapTest overlap_test_;
};

}  // namespace nearfield::solvers
