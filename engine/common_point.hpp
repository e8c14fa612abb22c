#pragma once

#include <engine/exact/meeting.hpp>
#include <engine/exact/placed_edges.hpp>

namespace nearfield {

/// Finds a point of two complete shapes that are known to share one, up to rounding. Keeps its
/// memory from pair to pair.
class CommonPoint {
public:
    [[nodiscard]] geometry::Vector find(const exact::PlacedEdges& a, const exact::PlacedEdges& b);

private:
    exact::MeetingFinder meeting_;
};

}  // namespace nearfield
