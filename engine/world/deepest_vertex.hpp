#pragma once

#include <engine/simd/transformed_edges.hpp>

#include <optional>
#include <vector>

namespace nearfield::world {

/// A vertex of one boundary, and the point of another boundary nearest to it.
struct DeepVertex {
    double depth = 0.0;
    geometry::Vector vertex = geometry::Vector::Zero();
    geometry::Vector nearest = geometry::Vector::Zero();
};

/// Finds the vertices of one shape that lie deepest in another. Keeps its memory.
class DeepestVertex {
public:
    /// Returns the deepest of the vertices of `inner` in `outer`, the first of equally deep ones;
    /// nothing if none is inside. Precondition: both are complete.
    [[nodiscard]] std::optional<DeepVertex> find(const simd::TransformedEdges& inner,
                                                 const simd::TransformedEdges& outer);

private:
    std::vector<double> x_;
    std::vector<double> y_;
};

}  // namespace nearfield::world
