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
};

/// A shape and the boxes over its edges.
struct EdgesInTree {
    const simd::TransformedEdges& edges;
    const simd::AabbTree& tree;
};

/// Finds the vertices of one shape that lie deepest in another. Keeps its memory.
class DeepestVertex {
public:
    /// Returns the deepest of the vertices of `inner` in `outer`, of equally deep ones the first;
    /// nothing if none is inside. The deeper the vertex `guess` is, the faster.
    [[nodiscard]] std::optional<DeepVertex> find(const EdgesInTree& inner, const EdgesInTree& outer,
                                                 std::uint32_t guess);

private:
    void take(std::uint32_t index, const EdgesInTree& inner, const EdgesInTree& outer);

    std::optional<DeepVertex> deepest_;
    std::uint32_t near_ = 0;            // an edge near the last vertex
    std::vector<std::uint32_t> found_;  // scratch
};

}  // namespace nearfield::world
