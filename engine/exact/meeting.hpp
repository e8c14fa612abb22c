#pragma once

#include <engine/exact/placed_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::exact {

/// Finds out whether two closed shapes share a point, as localize::intersects: boundaries meet
/// (touching counts, and so does a gap that the rounding of the placed vertices can account for),
/// or one shape holds the other. Small shapes are looked at edge by edge, others by their
/// hierarchies. Keeps its memory from pair to pair.
class MeetingFinder {
public:
    [[nodiscard]] bool intersect(const PlacedEdges& a, const PlacedEdges& b);

    /// The same of shapes of which no vertex of A lies in B, which leaves less to look at.
    [[nodiscard]] bool intersect_without_vertex_inside(const PlacedEdges& a, const PlacedEdges& b);

    /// Of small shapes: true where their boundaries meet, with a pair of edges that do.
    [[nodiscard]] bool boundaries_meet(const PlacedEdges& a, const PlacedEdges& b, EdgePair& edges);

private:
    /// Some of the edges of a polygon in arrays of their own.
    class Picked {
    public:
        void pick(const PlacedEdges& from, const Extent& box);
        [[nodiscard]] bool empty() const { return count_ == 0; }
        [[nodiscard]] EdgeArrays edges() const;
        /// Its index in the polygon.
        [[nodiscard]] std::uint32_t index(std::uint32_t edge) const { return indices_[edge]; }

    private:
        static constexpr std::size_t room = padded(most_edges_one_by_one);
        std::uint32_t count_ = 0;
        std::uint32_t indices_[room];
        double start_x_[room];
        double start_y_[room];
        double end_x_[room];
        double end_y_[room];
    };

    Picked of_a_;
    Picked of_b_;
};

}  // namespace nearfield::exact
