#pragma once

#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::world {

/// A vertex of one boundary, and the point of another boundary nearest to it.
struct DeepVertex {
    double depth = 0.0;
    std::uint32_t index = 0;
    geometry::Vector vertex = geometry::Vector::Zero();
    geometry::Vector nearest = geometry::Vector::Zero();
    std::uint32_t edge = 0;  ///< that `nearest` lies on
};

/// A shape and the boxes over its edges.
struct EdgesInTree {
    const simd::TransformedEdges& edges;
    const simd::AabbTree* tree;  ///< may be null for an inner shape of few edges
};

/// A vertex, and an edge of the other shape near it.
struct VertexGuess {
    std::uint32_t vertex = UINT32_MAX;
    std::uint32_t edge = 0;
};

/// Finds the vertices of one shape that lie deepest in another. Keeps its memory.
class DeepestVertex {
public:
    /// Returns the deepest of the vertices of `inner` in `outer`, of equally deep ones the first;
    /// nothing if none is inside. The deeper the vertex of the guess is, and the nearer its edge,
    /// the faster.
    [[nodiscard]] std::optional<DeepVertex> find(const EdgesInTree& inner, const EdgesInTree& outer,
                                                 const VertexGuess& guess);

private:
    void take(std::uint32_t index, const EdgesInTree& inner, const EdgesInTree& outer);
    /// Lists the vertices that may be inside; returns their number.
    [[nodiscard]] std::uint32_t find_candidates(const EdgesInTree& inner, const EdgesInTree& outer);
    /// Writes the squared distances of the found vertices from the edge near the last vertex.
    void bound_depths(const EdgesInTree& inner, const EdgesInTree& outer, std::uint32_t count);

    std::optional<DeepVertex> deepest_;
    std::uint32_t near_ = 0;            // an edge near the last vertex
    std::vector<std::uint32_t> found_;  // scratch
    std::vector<double> bounds_;        // squared, on the depths of those found
};

}  // namespace nearfield::world
