#pragma once

#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::narrowphase {

/// Finds the vertex-edge pairs of two boundaries that are close to each other. Separate boundaries
/// first touch where a vertex of one reaches an edge of the other, so no other pairs are listed.
/// Uses AABB trees. Reuses its memory between pairs.
class VertexEdgePairFinder {
public:
    /// Starts a new pair, or new poses. The edges must be complete and must outlive the calls of
    /// find().
    void begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b);

    /// Lists every vertex and edge at most `distance` apart, and perhaps a few more. Returns false,
    /// with only some of them listed, if there are more than `most`.
    [[nodiscard]] bool find(double distance, std::size_t most);
    [[nodiscard]] const std::vector<simd::VertexAndEdge>& found() const { return found_; }

private:
    /// Returns false if there are too many.
    [[nodiscard]] bool add_near_edges(const simd::TransformedEdges& vertices,
                                      const simd::TransformedEdges& edges, bool vertex_of_first,
                                      double squared, std::size_t most);

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    std::vector<std::uint32_t> edges_;  // near one vertex; the rest is spare capacity
    std::vector<simd::VertexAndEdge> found_;
};

}  // namespace nearfield::narrowphase
