#pragma once

#include <engine/common_point.hpp>
#include <engine/exact/closest_pair.hpp>
#include <engine/exact/meeting.hpp>
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
                std::span<const std::uint32_t> words, exact::PlacedInstances& instances,
                ClosestPointResult& result);
    void decode(const plan::Plan& plan, const plan::PlannedQuery& query,
                std::span<const std::uint32_t> words, exact::PlacedInstances& instances,
                SeparationResult& result);

private:
    /// Technique::cpu: all from the shapes themselves.
    void answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                SeparationResult& result);
    /// Of complete shapes that are apart. `at_most`: as far as is known.
    void answer_apart(const plan::PlannedQuery& query, const exact::PlacedEdges& a,
                      const exact::PlacedEdges& b, double at_most, SeparationResult& result);

    exact::ClosestPairFinder finder_;
    exact::MeetingFinder meeting_;
    CommonPoint common_point_;
};

}  // namespace nearfield
