#pragma once

#include <engine/exact/placed_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::exact {

/// Two boundary points, one on each of two polygons.
struct ClosestPair {
    std::uint32_t edge_a = 0;
    std::uint32_t edge_b = 0;
    geometry::Vector point_a = geometry::Vector::Zero();
    geometry::Vector point_b = geometry::Vector::Zero();
    double parameter_a = 0.0;  ///< of point_a on edge_a: 0 at its first vertex, 1 at its last
    double parameter_b = 0.0;
    double squared_distance = std::numeric_limits<double>::infinity();
};

/// Whose closest point is asked about.
enum class Side : std::uint8_t { a, either };

/// The closest points of two boundaries that do not meet, exact up to the rounding of double
/// precision: segments that do not cross are closest at an end of one of them, so the vertices of
/// either are held against the edges of the other, as far as the boxes over them say that they can
/// be the closest. Swapping the shapes leaves the distance the same, bit for bit. Keeps its memory
/// from call to call.
class ClosestPairFinder {
public:
    /// Of complete edges whose boundaries do not meet. `at_most`: some two boundary points are
    /// known to be no farther apart; infinity where nothing is known. `margin`: the largest that
    /// is_unique() will be asked with.
    ClosestPair find(const PlacedEdges& a, const PlacedEdges& b, double at_most, double margin);

    /// Of the pair that the last find() gave: false where two other boundary points are no farther
    /// apart than it and `margin`, and the one of A, or one of either, is more than `apart` away
    /// from the pair's own. The edges are still those of find().
    [[nodiscard]] bool is_unique(const ClosestPair& closest, Side side, double margin,
                                 double apart) const;

private:
    /// A vertex and an edge as points of A and B.
    [[nodiscard]] ClosestPair pair_of(const VertexAndEdge& found) const;
    /// Of some vertices to edges near them: no less than the least distance.
    [[nodiscard]] double squared_bound() const;
    /// Keeps what is as close as the closest and a margin, and some more; stops once there are more
    /// than `most_pairs`. Returns the square of the least distance so far.
    [[nodiscard]] double keep_near(double most, double margin, std::size_t most_pairs);

    const PlacedEdges* a_ = nullptr;
    const PlacedEdges* b_ = nullptr;
    std::vector<VertexAndEdge> near_;  // those that may be the closest, and as close up to a margin
    bool keeps_all_ = true;            // of the latter
};

}  // namespace nearfield::exact
