#pragma once

#include <engine/narrowphase/candidate_edge_pairs.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::narrowphase {

/// Moves of the boundaries that ContainmentTest cannot distinguish from none, in world units.
[[nodiscard]] inline double containment_rounding(const simd::TransformedEdges& a,
                                                 const simd::TransformedEdges& b) {
    return 8.0 * (a.rounding + b.rounding);
}

/// Tests whether every point of closed shape A is a point of closed shape B. Touching from inside
/// is inside; so is whatever containment_rounding() could make so, and nothing that is inside
/// without it is ever rejected. Uses brute force for two small shapes and AABB trees otherwise.
/// Precondition: unless both are small, both are complete if their boxes intersect. Reuses its
/// memory between pairs.
class ContainmentTest {
public:
    [[nodiscard]] bool is_inside(const simd::TransformedEdges& a, const simd::TransformedEdges& b);

private:
    /// A part of an edge that is on the other boundary, up to rounding.
    struct TouchingPart {
        std::uint32_t edge = 0;
        double from = 0.0;  ///< parameters along the edge
        double to = 1.0;
    };

    void find_touching_parts();
    /// Whether no part of A's boundary lies outside B.
    [[nodiscard]] bool boundary_is_inside() const;
    /// Whether some part of B's boundary has a side that is inside A and outside B.
    [[nodiscard]] bool contains_outside();
    [[nodiscard]] bool ring_borders_outside(std::uint32_t begin, std::uint32_t end,
                                            std::span<const TouchingPart> touching);
    [[nodiscard]] bool borders_outside(std::uint32_t edge, double from, double to);
    void cut_where_edges_begin_and_end(std::uint32_t edge, double from, double to);
    [[nodiscard]] bool is_proof(const geometry::Vector& point) const;

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    double rounding_ = 0.0;  // of both
    CandidateEdgePairs pairs_;
    std::vector<TouchingPart> on_a_;  // in order along the boundary
    std::vector<TouchingPart> on_b_;
    std::vector<std::uint32_t> near_;  // scratch: edges
    std::vector<double> cuts_;         // scratch: parameters along an edge
};

}  // namespace nearfield::narrowphase
