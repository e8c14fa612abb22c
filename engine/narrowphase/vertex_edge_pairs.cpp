#include <engine/narrowphase/vertex_edge_pairs.hpp>

#include <algorithm>

namespace nearfield::narrowphase {

void VertexEdgePairFinder::begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
    a_ = &a;
    b_ = &b;
    edges_.resize(std::max(edges_.size(), simd::padded(std::max(a.count, b.count))));
}

bool VertexEdgePairFinder::add_near_edges(const simd::TransformedEdges& vertices,
                                          const simd::TransformedEdges& edges, bool vertex_of_first,
                                          double squared, std::size_t most) {
    const simd::AabbTree tree = edges.tree();
    for (std::uint32_t vertex = 0; vertex < vertices.count && found_.size() <= most; ++vertex) {
        const geometry::Vector point = vertices.start(vertex);
        if (edges.box.squaredExteriorDistance(point) > squared) {
            continue;
        }
        const std::uint32_t near =
            simd::kernels::find_edges_within(tree, point.x(), point.y(), squared, edges_.data());
        for (std::uint32_t k = 0; k < near; ++k) {
            found_.push_back({vertex, edges_[k], vertex_of_first, squared});
        }
    }
    return found_.size() <= most;
}

bool VertexEdgePairFinder::find(double distance, std::size_t most) {
    // Covers the rounding of the kernels, the boxes and the transformed vertices.
    const double limit = distance * (1.0 + 1e-12) + a_->rounding + b_->rounding;
    found_.clear();
    return add_near_edges(*a_, *b_, true, limit * limit, most) &&
           add_near_edges(*b_, *a_, false, limit * limit, most);
}

}  // namespace nearfield::narrowphase
