#pragma once

#include <engine/geometry/segment.hpp>
#include <engine/simd/ordered_search.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace nearfield::narrowphase {

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

/// The shapes whose closest point has to be unique.
enum class Side : std::uint8_t { a, either };

/// The closest points of two boundaries that do not intersect, exact up to double-precision
/// rounding. Segments that do not cross are closest at an end of one of them, so the vertices of
/// each boundary are tested against those edges of the other that their AABB trees do not exclude.
/// Swapping the shapes leaves the distance unchanged, bit for bit. Reuses its memory between calls.
class ClosestPairFinder {
public:
    /// Precondition: complete edges, boundaries that do not intersect. `at_most`: a known upper
    /// bound on the boundaries' distance, or infinity. `margin`: the largest that is_unique() will
    /// be called with.
    ClosestPair find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                     double at_most, double margin);

    /// The same for a shape A of at most simd::max_few_edges edges, whose boxes are not needed, and
    /// a shape B with its tree; not to be followed by is_unique(). `direction`: as that of
    /// simd::FewEdges.
    ClosestPair find_of_few(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                            const simd::AabbTree& tree_b, double at_most,
                            const geometry::Vector& direction);

    /// For the pair returned by the last find(): false if two other boundary points have a distance
    /// at most `margin` above the pair's, and the one on A, or either one, is more than `apart`
    /// away from the pair's own. The edges must be those of find().
    [[nodiscard]] bool is_unique(const ClosestPair& closest, Side side, double margin,
                                 double apart) const;

private:
    /// The point of an edge nearest to a vertex.
    [[nodiscard]] geometry::NearestOnSegment nearest_of(const simd::VertexAndEdge& found) const;
    /// The two as points of A and B.
    [[nodiscard]] ClosestPair pair_of(const simd::VertexAndEdge& found,
                                      const geometry::NearestOnSegment& nearest) const;
    /// An upper bound from some vertices and edges near them; at most the one that is known.
    [[nodiscard]] double squared_bound(double known) const;
    /// The closest of those kept.
    [[nodiscard]] ClosestPair pick(double least) const;
    /// Keeps the pairs within `margin` of the closest, and some more; stops once there are more
    /// than `max_pairs`. Returns the square of the least distance so far.
    [[nodiscard]] double keep_near(double most, double margin, std::size_t max_pairs);

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    std::optional<simd::AabbTree> tree_a_;
    std::optional<simd::AabbTree> tree_b_;
    std::vector<simd::VertexAndEdge>
        near_;               // candidates for the closest, and those as close up to the margin
    bool keeps_all_ = true;  // near_ has all of the latter
    std::vector<simd::NearPair> near_few_;
};

}  // namespace nearfield::narrowphase
