#pragma once

#include <engine/geometry/transformed_polygon.hpp>
#include <nearfield/localization.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::geometry {

/// Consecutive edges of one ring: first, first + 1, ... (wrapping at the ring's end), and their
/// bounding box in the world.
struct Chain {
    std::uint32_t ring = 0;
    std::uint32_t first = 0;  ///< index of the first edge, counted through all rings
    std::uint32_t count = 0;
    Box box;
};

/// Work done by localisation, for statistics and tests.
struct Effort {
    std::uint64_t nodes_evaluated = 0;  ///< bounding volumes computed
    std::uint64_t pairs_rejected = 0;   ///< pairs of bounding volumes found disjoint
};

struct OverlapOptions {
    /// Maximum height of each tree: a ring has at most 2^height leaves. 0: top-level boxes only.
    std::uint32_t height = 12;
    /// The boxes of A are grown by this much on every side before they are compared with those of
    /// B, in world units.
    double grow = 0.0;
    BoundingVolume volume = BoundingVolume::axis_aligned;
};

/// The parts of A's boundary that may lie inside B or within `grow` of B's boundary: every omitted
/// chain lies wholly outside B and farther than `grow` from its boundary. Chains come in ring
/// order; neighbouring ones are joined. A chain that overlaps no bounding volume of B's boundary is
/// classified by one of its points: inside B or not (this detects containment without contact of
/// the boundaries). Appends to `chains`.
///
/// No tree is stored: a node is a range of edges, and its box is computed when it is visited
/// (section 2.1 of the paper).
Effort chains_in_volume(const TransformedPolygon& a, const TransformedPolygon& b,
                        const OverlapOptions& options, std::vector<Chain>& chains);

/// chains_in_volume() for A in B and for B in A, by a single descent.
Effort chains_in_each_other(const TransformedPolygon& a, const TransformedPolygon& b,
                            const OverlapOptions& options, std::vector<Chain>& of_a,
                            std::vector<Chain>& of_b);

/// The parts of A's boundary that may come within `grow` of B's boundary. Appends to `chains`.
Effort chains_near_boundary(const TransformedPolygon& a, const TransformedPolygon& b,
                            const OverlapOptions& options, std::vector<Chain>& chains);

/// Joins boxes into fewer: always those that overlap, others if the joint box is hardly larger than
/// the two. The resulting boxes are disjoint and cover the given ones. In place.
void join_boxes(std::vector<Box>& boxes);

}  // namespace nearfield::geometry
