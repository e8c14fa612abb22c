#pragma once

#include <engine/exact/meeting.hpp>
#include <engine/placed_pair.hpp>
#include <nearfield/result.hpp>

namespace nearfield {

/// Answers intersection tests, from query to result. Keeps its memory from batch to batch.
class IntersectionTest {
public:
    /// Whether the shapes of any query share a point.
    [[nodiscard]] bool intersect(const plan::PlannedQuery& query,
                                 exact::PlacedInstances& instances);
    /// Writes a result whose status is good.
    void answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                IntersectionTestResult& result);

private:
    exact::MeetingFinder meeting_;
};

}  // namespace nearfield
