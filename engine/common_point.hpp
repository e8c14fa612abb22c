#pragma once

#include <engine/exact/closest_pair.hpp>
#include <engine/exact/meeting.hpp>
#include <engine/exact/placed_edges.hpp>

namespace nearfield {

/// Finds a point of two shapes that are known to share one, up to rounding. Keeps its memory from
/// pair to pair.
class CommonPoint {
public:
    [[nodiscard]] geometry::Vector find(const exact::PlacedEdges& a, const exact::PlacedEdges& b);

    /// The same of shapes of any size, by their hierarchies. `rounding`: of placed vertices.
    [[nodiscard]] geometry::Vector find(const geometry::PlacedPolygon& a,
                                        const geometry::PlacedPolygon& b, double rounding);

private:
    exact::MeetingFinder meeting_;
    exact::ClosestPairFinder finder_;
};

}  // namespace nearfield
