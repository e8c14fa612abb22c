#pragma once

#include <engine/narrowphase/candidate_edge_pairs.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::narrowphase {

/// A part of an edge of A where the edge may cross B's boundary.
struct Crossing {
    std::uint32_t edge = 0;
    double from = 0.0;  ///< parameter along the edge
    double to = 1.0;
};

/// Finds where the edges of a transformed polygon cross another's boundary. Between two consecutive
/// crossings the boundary stays on one side. Reuses its memory between pairs.
class CrossingFinder {
public:
    /// Returns all crossings, sorted by edge, then by start; they may overlap. Each covers the part
    /// that the rounding of the vertices leaves undecided. Where too many pairs of edges would have
    /// to be compared, all edges are returned whole. Precondition: unless both polygons are
    /// small, both are complete. Valid until the next call.
    [[nodiscard]] std::span<const Crossing> find(const simd::TransformedEdges& a,
                                                 const simd::TransformedEdges& b);
    /// The same if the previous call had the same polygons in the opposite order.
    [[nodiscard]] std::span<const Crossing> find_reversed(const simd::TransformedEdges& a,
                                                          const simd::TransformedEdges& b);

private:
    [[nodiscard]] std::span<const Crossing> cut(const simd::TransformedEdges& a,
                                                const simd::TransformedEdges& b);

    CandidateEdgePairs candidates_;
    bool has_pairs_ = true;
    std::vector<simd::EdgePair> pairs_;  // candidate pairs of an edge of A and one of B
    std::vector<Crossing> found_;
};

}  // namespace nearfield::narrowphase
