#include <engine/geometry/segment.hpp>
#include <engine/world/deepest_vertex.hpp>

#include <cmath>

namespace nearfield::world {

using geometry::Vector;

void DeepestVertex::take(std::uint32_t index, const EdgesInTree& inner, const EdgesInTree& outer) {
    const Vector vertex = inner.edges.start(index);
    if (!outer.edges.box.contains(vertex)) {
        return;
    }
    const auto nearest_on = [&](std::uint32_t edge) {
        return geometry::nearest_on_segment(vertex, outer.edges.start(edge), outer.edges.end(edge));
    };
    const auto replaces = [&](double depth) {
        return !deepest_ || depth > deepest_->depth ||
               (depth == deepest_->depth && index < deepest_->index);
    };
    const double guess = nearest_on(near_).squared_distance;
    if (!replaces(std::sqrt(guess)) ||
        !simd::kernels::contain(outer.tree, vertex.x(), vertex.y())) {
        return;
    }
    near_ = simd::kernels::find_nearer(outer.tree, vertex.x(), vertex.y(), {near_, guess}).edge;
    const geometry::NearestOnSegment nearest = nearest_on(near_);
    const double depth = std::sqrt(nearest.squared_distance);
    if (replaces(depth)) {
        deepest_ = {depth, index, vertex, nearest.point};
    }
}

std::optional<DeepVertex> DeepestVertex::find(const EdgesInTree& inner, const EdgesInTree& outer,
                                              std::uint32_t guess) {
    deepest_.reset();
    near_ = 0;
    if (guess < inner.edges.count) {
        take(guess, inner, outer);
    }
    if (found_.size() < simd::padded(inner.edges.count)) {
        found_.resize(simd::padded(inner.edges.count));
    }
    const std::uint32_t count = simd::kernels::find_edges_in(
        inner.tree, geometry::extent_of(outer.edges.box), found_.data());
    for (std::uint32_t i = 0; i < count; ++i) {
        take(found_[i], inner, outer);
    }
    return deepest_;
}

}  // namespace nearfield::world
