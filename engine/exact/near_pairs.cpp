#include <engine/exact/near_pairs.hpp>

#include <algorithm>

namespace nearfield::exact {

void NearPairFinder::begin(const PlacedEdges& a, const PlacedEdges& b) {
    a_ = &a;
    b_ = &b;
    edges_.resize(std::max(edges_.size(), padded(std::max(a.count, b.count))));
}

bool NearPairFinder::add_near_edges(const PlacedEdges& vertices, const PlacedEdges& edges,
                                    bool vertex_of_first, double squared, std::size_t most) {
    const BoxTree tree = edges.tree();
    for (std::uint32_t vertex = 0; vertex < vertices.count && found_.size() <= most; ++vertex) {
        const geometry::Vector point = vertices.start(vertex);
        if (edges.box.squaredExteriorDistance(point) > squared) {
            continue;
        }
        const std::uint32_t near =
            kernels::find_edges_within(tree, point.x(), point.y(), squared, edges_.data());
        for (std::uint32_t k = 0; k < near; ++k) {
            found_.push_back({vertex, edges_[k], vertex_of_first, squared});
        }
    }
    return found_.size() <= most;
}

bool NearPairFinder::find(double distance, std::size_t most) {
    // More than what the kernels, the boxes or placing the vertices may have rounded.
    const double limit = distance * (1.0 + 1e-12) + a_->rounding + b_->rounding;
    found_.clear();
    return add_near_edges(*a_, *b_, true, limit * limit, most) &&
           add_near_edges(*b_, *a_, false, limit * limit, most);
}

}  // namespace nearfield::exact
