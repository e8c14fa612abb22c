#pragma once

#include <engine/mtv/separating_translation.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

namespace nearfield::solvers {

/// Answers separation-vector queries. Reuses its memory between batches.
class SeparationVectorSolver {
public:
    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                SeparationVectorResult& result);

private:
    mtv::SeparatingTranslationFinder finder_;
};

}  // namespace nearfield::solvers
