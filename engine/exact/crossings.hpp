#pragma once

#include <engine/exact/meeting_pairs.hpp>
#include <engine/exact/placed_edges.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::exact {

/// A part of an edge of A where the edge may cross B's boundary.
struct Crossing {
    std::uint32_t edge = 0;
    double from = 0.0;  ///< of the way along the edge
    double to = 1.0;
};

/// Finds where the edges of a placed polygon cross another's boundary: between two crossings that
/// follow each other along the boundary it stays on one side. Keeps its memory from pair to pair.
class CrossingFinder {
public:
    /// Sorted by edge, then by where they begin; they may overlap. All crossings, and as much about
    /// each as the rounding of the vertices leaves open. Where either polygon is not small both
    /// have to be complete. Valid until the next call.
    [[nodiscard]] std::span<const Crossing> find(const PlacedEdges& a, const PlacedEdges& b);
    /// The same where the call before was about the same polygons, the other way round.
    [[nodiscard]] std::span<const Crossing> find_reversed(const PlacedEdges& a,
                                                          const PlacedEdges& b);

private:
    [[nodiscard]] std::span<const Crossing> cut(const PlacedEdges& a, const PlacedEdges& b);

    MeetingPairs meeting_;
    std::vector<EdgePair> pairs_;  // that may meet, of A and of B
    std::vector<Crossing> found_;
};

}  // namespace nearfield::exact
