#pragma once

#include <engine/solvers/common_point.hpp>
#include <engine/solvers/workspace.hpp>
#include <engine/toi/conservative_advancement.hpp>
#include <nearfield/result.hpp>

namespace nearfield::solvers {

/// Answers time-of-impact queries. Reuses its memory between batches.
class TimeOfImpactSolver {
public:
    void answer(const plan::CheckedQuery& query, Workspace& workspace, TimeOfImpactResult& result);

private:
    toi::ConservativeAdvancement finder_;
    CommonPoint common_point_;
};

}  // namespace nearfield::solvers
