#pragma once

#include <engine/geometry/placed_polygon.hpp>
#include <nearfield/localization.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::localize {

/// Consecutive edges of one ring: first, first + 1, ... (wrapping at the ring's end), and the
/// world box around them.
struct Chain {
    std::uint32_t ring = 0;
    std::uint32_t first = 0;  ///< index of the first edge, counted through all rings
    std::uint32_t count = 0;
    geometry::Box box;
};

/// What localisation did, for statistics and tests.
struct Effort {
    std::uint64_t nodes_evaluated = 0;  ///< bounding volumes computed
    std::uint64_t pairs_rejected = 0;   ///< pairs of bounding volumes found apart

    Effort& operator+=(const Effort& other) {
        nodes_evaluated += other.nodes_evaluated;
        pairs_rejected += other.pairs_rejected;
        return *this;
    }
};

struct OverlapOptions {
    /// Maximum height of each tree: a ring has at most 2^height leaves. 0: top-level boxes only.
    std::uint32_t height = 12;
    /// The boxes of A are grown by this much on every side before they are held against those of
    /// B, world units.
    double grow = 0.0;
    BoundingVolume volume = BoundingVolume::axis_aligned;
};

/// The parts of A's boundary that may lie inside B or within `grow` of B's boundary: every chain
/// that is left out lies wholly outside B and farther than `grow` from its boundary. Chains come
/// in ring order; neighbouring ones are joined. A chain that meets no bounding volume of B's
/// boundary is settled by one point of it: inside B or not (so containment without contact of the
/// boundaries is found). Appends to `chains`.
///
/// No tree is stored: a node is a range of edges, its box is computed when it is visited (section
/// 2.1 of the paper).
Effort chains_in_volume(const geometry::PlacedPolygon& a, const geometry::PlacedPolygon& b,
                        const OverlapOptions& options, std::vector<Chain>& chains);

/// The same of A in B and of B in A, by one descent.
Effort chains_in_each_other(const geometry::PlacedPolygon& a, const geometry::PlacedPolygon& b,
                            const OverlapOptions& options, std::vector<Chain>& of_a,
                            std::vector<Chain>& of_b);

/// The parts of A's boundary that may come within `grow` of B's boundary. Appends to `chains`.
Effort chains_near_boundary(const geometry::PlacedPolygon& a, const geometry::PlacedPolygon& b,
                            const OverlapOptions& options, std::vector<Chain>& chains);

/// True where the closed shapes share a point: boundaries meet (touching counts, and so does a gap
/// that the rounding of the placed vertices can account for), or one shape holds the other. The
/// same hierarchy, driven down to a few edges, with an early way out. Adds what it did to `effort`
/// where that is given.
[[nodiscard]] bool intersects(const geometry::PlacedPolygon& a, const geometry::PlacedPolygon& b,
                              BoundingVolume volume = BoundingVolume::axis_aligned,
                              Effort* effort = nullptr);

/// Joins boxes into fewer: boxes that overlap always, others where the joint box is hardly larger
/// than the two. Result: disjoint boxes that cover the given ones. In place.
void join_boxes(std::vector<geometry::Box>& boxes);

}  // namespace nearfield::localize
