#pragma once

#include <engine/cpu/common_point.hpp>
#include <engine/plan/plan.hpp>
#include <engine/toi/conservative_advancement.hpp>
#include <nearfield/result.hpp>

namespace nearfield::cpu {

/// Answers time-of-impact queries, from query to result. Reuses its memory between batches.
class TimeOfImpact {
public:
    /// Writes a result whose status is good.
    void answer(const plan::PlannedQuery& planned, TimeOfImpactResult& result);

private:
    toi::ConservativeAdvancement finder_;
    CommonPoint common_point_;
};

}  // namespace nearfield::cpu
