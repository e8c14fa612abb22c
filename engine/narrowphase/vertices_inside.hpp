#pragma once

#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::narrowphase {

/// Counts the vertices of one shape inside another, and lists those that may be the deepest. A box
/// of the first that no edge of the other comes near lies on one side as a whole, so one of its
/// vertices decides for all. Reuses its memory.
class VerticesInside {
public:
    /// Lists vertices of A in the box of B: in order, all that lie within `touching` of B's
    /// boundary, all that may be the deepest inside, and others. Precondition: both are
    /// prepared and have a tree, that of A in order.
    void find(const simd::TransformedEdges& a, const simd::TransformedEdges& b, double touching,
              simd::PointList& vertices);
    /// How many more are inside, deeper than `touching`.
    [[nodiscard]] std::uint32_t left_out() const { return left_out_; }

private:
    /// A box of A inside B.
    struct Inside {
        std::uint32_t level = 0;
        std::uint32_t box = 0;
        std::uint32_t edge = 0;    ///< of B, near it or near the box around it
        double most = 0.0;         ///< from that edge: its vertices are no deeper
        bool is_measured = false;  ///< the edge is near its own vertices
    };
    struct Vertex {
        double most = 0.0;
        std::uint32_t index = 0;
    };

    /// Tells on which side of B's boundary eight boxes of A lie.
    void divide(std::uint32_t level, std::uint32_t first);
    void find_deepest();
    /// Adds a box of A, unless a vertex is known that is deeper than all of its own.
    void add(const Inside& inside);
    /// The same for the boxes in it, or for its vertices.
    void open(const Inside& inside);
    /// Measures how deep a vertex is; returns the edge of B that is nearest, beginning with a
    /// guess.
    std::uint32_t measure(std::uint32_t vertex, std::uint32_t guess);
    /// How far any vertex of a box can be from its edge of B.
    [[nodiscard]] double farthest(const Inside& inside) const;
    [[nodiscard]] bool may_be_deepest(double most) const;
    void list(simd::PointList& vertices);

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    std::optional<simd::AabbTree> tree_a_;
    std::optional<simd::AabbTree> tree_b_;
    double clear_ = 0.0;    // of boxes from the boundary
    double deepest_ = 0.0;  // a vertex is that deep
    std::uint32_t left_out_ = 0;
    std::vector<Inside> found_;
    std::vector<Inside> inside_;  // a heap, the deepest first
    std::vector<Vertex> deep_;
    std::vector<std::uint32_t> listed_;
};

}  // namespace nearfield::narrowphase
