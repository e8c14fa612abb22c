#pragma once

#include <engine/exact/placed_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::exact {

/// Finds what of two boundaries is close to each other: boundaries that are apart touch first where
/// a vertex of either comes to an edge of the other, so nothing else is listed. They are looked at
/// by boxes over their edges. Keeps its memory from pair to pair.
class NearPairFinder {
public:
    /// For another pair, or other poses, from here on. Complete edges, which must outlive the calls
    /// of find().
    void begin(const PlacedEdges& a, const PlacedEdges& b);

    /// Lists every vertex and edge no farther apart than `distance`, and perhaps a few more. False,
    /// and some of them, where there are more than `most`.
    [[nodiscard]] bool find(double distance, std::size_t most);
    [[nodiscard]] const std::vector<VertexAndEdge>& found() const { return found_; }

private:
    /// False where there are too many.
    [[nodiscard]] bool add_near_edges(const PlacedEdges& vertices, const PlacedEdges& edges,
                                      bool vertex_of_first, double squared, std::size_t most);

    const PlacedEdges* a_ = nullptr;
    const PlacedEdges* b_ = nullptr;
    std::vector<std::uint32_t> edges_;  // near one vertex; the rest is room
    std::vector<VertexAndEdge> found_;
};

}  // namespace nearfield::exact
