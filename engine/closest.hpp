#pragma once

#include <engine/exact/closest_pair.hpp>
#include <engine/plan/gpu_layout.hpp>
#include <engine/plan/plan.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>

namespace nearfield {

/// Decodes closest points and separations: the rendered samples give an upper bound, and an exact
/// search below it the answer.
class ClosestDecoder {
public:
    /// `words` by point of the plan. Whether the shapes intersect stands in the result already.
    void decode(const plan::Plan& plan, const plan::PlannedQuery& query,
                std::span<const std::uint32_t> words, ClosestPointResult& result);
    void decode(const plan::Plan& plan, const plan::PlannedQuery& query,
                std::span<const std::uint32_t> words, SeparationResult& result);

private:
    exact::ClosestPairFinder finder_;
};

}  // namespace nearfield
