#pragma once

#include <engine/common_point.hpp>
#include <engine/exact/first_contact.hpp>
#include <engine/plan/plan.hpp>
#include <nearfield/result.hpp>

namespace nearfield {

/// Answers times of impact, from query to result. Keeps its memory from batch to batch.
class TimeOfImpact {
public:
    /// Writes a result whose status is good.
    void answer(const plan::PlannedQuery& planned, TimeOfImpactResult& result);

private:
    exact::FirstContactFinder finder_;
    CommonPoint common_point_;
};

}  // namespace nearfield
