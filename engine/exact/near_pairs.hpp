#pragma once

#include <engine/exact/placed_edges.hpp>
#include <engine/localize/lazy_tree.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::exact {

/// A vertex of one shape and an edge of the other.
struct VertexAndEdge {
    bool vertex_of_a = true;
    std::uint32_t vertex = 0;
    std::uint32_t edge = 0;
};

/// Finds what of two boundaries is close to each other: boundaries that are apart touch first where
/// a vertex of either comes to an edge of the other, so nothing else is listed. Small shapes are
/// looked at edge by edge, others by their hierarchies. Keeps its memory from pair to pair.
class NearPairFinder {
public:
    /// For another pair, or other poses, from here on. The shapes must outlive the calls of find().
    void begin(const PlacedEdges& a, const PlacedEdges& b);

    /// Lists every vertex and edge no farther apart than `distance`, and perhaps a few more. False,
    /// and some of them, where there are more than `most`.
    [[nodiscard]] bool find(double distance, std::size_t most);
    [[nodiscard]] const std::vector<VertexAndEdge>& found() const { return found_; }

private:
    /// False where there are too many.
    [[nodiscard]] bool add_near_edges(const PlacedEdges& vertices, const PlacedEdges& edges,
                                      bool vertex_of_a, double squared, std::size_t most);

    static constexpr std::size_t room = padded(most_edges_one_by_one);
    const PlacedEdges* a_ = nullptr;
    const PlacedEdges* b_ = nullptr;
    bool by_trees_ = false;
    std::array<std::uint32_t, room> vertices_;
    std::array<std::uint32_t, room> edges_;
    localize::LazyTree tree_a_;
    localize::LazyTree tree_b_;
    std::vector<VertexAndEdge> found_;
};

}  // namespace nearfield::exact
