#pragma once

#include <engine/exact/meeting_pairs.hpp>
#include <engine/exact/placed_edges.hpp>

namespace nearfield::exact {

/// Finds out whether two closed shapes share a point, as localize::intersects: boundaries meet
/// (touching counts, and so does a gap that the rounding of the placed vertices can account for),
/// or one shape holds the other. Two small shapes are looked at edge by edge, others by boxes over
/// their edges: where either is not small, both have to be complete if their boxes meet. Keeps its
/// memory from pair to pair.
class MeetingFinder {
public:
    [[nodiscard]] bool intersect(const PlacedEdges& a, const PlacedEdges& b);

    /// The same of shapes of which no vertex of A lies in B, which leaves less to look at.
    [[nodiscard]] bool intersect_without_vertex_inside(const PlacedEdges& a, const PlacedEdges& b);

    /// True where their boundaries meet, with a pair of edges that do; otherwise `edges` is left as
    /// it may be.
    [[nodiscard]] bool boundaries_meet(const PlacedEdges& a, const PlacedEdges& b, EdgePair& edges);

private:
    MeetingPairs pairs_;
};

}  // namespace nearfield::exact
