#pragma once

#include <engine/exact/closest_pair.hpp>
#include <engine/exact/placed_edges.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nearfield::exact {

/// The closest points of two boundaries of few edges that do not meet, exact up to the rounding of
/// double precision, without a tree: segments that do not cross are closest at an end of one of
/// them, so the vertices of either are held against the edges of the other. Swapping the shapes
/// leaves the distance the same, bit for bit.
class ClosestEdges {
public:
    /// Precondition, as of is_unique(): both are small (is_small) and their boundaries do not meet.
    [[nodiscard]] ClosestPair find(const PlacedEdges& a, const PlacedEdges& b);

    /// As ClosestPairFinder::is_unique, of the pair that the last find() gave for the same shapes.
    [[nodiscard]] bool is_unique(const PlacedEdges& a, const PlacedEdges& b,
                                 const ClosestPair& closest, Side side, double margin,
                                 double apart);

private:
    static constexpr std::size_t room = padded(most_edges_one_by_one);

    /// Vertices of one shape near the other, with their squared distances from its edges.
    struct Near {
        std::uint32_t count = 0;
        std::array<std::uint32_t, room> vertices;
        std::array<double, room> squared;

        /// All that are so near to the other shape's box.
        void find(const PlacedEdges& from, const PlacedEdges& edges, double most);
        [[nodiscard]] double least() const;
    };

    void find_near(const PlacedEdges& a, const PlacedEdges& b, double most);
    /// Calls `use(vertex, edge)` for what is at most so far apart, up to rounding; not farther than
    /// what find_near() looked for.
    template <class Use>
    void for_each_within(const Near& near, const PlacedEdges& vertices, const PlacedEdges& edges,
                         double most, const Use& use);

    Near of_a_;
    Near of_b_;
    double most_ = 0.0;  // squared: how far these were looked for
    std::array<std::uint32_t, room> edges_;
};

}  // namespace nearfield::exact
