#include <engine/geometry/segment.hpp>
#include <engine/world/deepest_vertex.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nearfield::world {

using geometry::Vector;

namespace {

/// Slightly more than a length that was rounded.
double rounded_up(double length, double rounding) {
    return length * (1.0 + 1e-12) + rounding;
}

}  // namespace

void DeepestVertex::bound_depths(const EdgesInTree& inner, const EdgesInTree& outer,
                                 std::uint32_t count) {
    const Vector start = outer.edges.start(near_);
    const Vector along = outer.edges.end(near_) - start;
    const double squared = along.squaredNorm();
    const double inverse = squared > 0.0 ? 1.0 / squared : 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = inner.edges.start_x[found_[i]] - start.x();
        const double y = inner.edges.start_y[found_[i]] - start.y();
        const double parameter =
            std::min(std::max((x * along.x() + y * along.y()) * inverse, 0.0), 1.0);
        const double off_x = x - parameter * along.x();
        const double off_y = y - parameter * along.y();
        bounds_[i] = off_x * off_x + off_y * off_y;
    }
}

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
    if (!replaces(std::sqrt(guess))) {
        return;
    }
    // Around the deepest vertex so far there is no boundary within its depth.
    const bool is_surely_inside =
        deepest_ && rounded_up((vertex - deepest_->vertex).norm(),
                               inner.edges.rounding + outer.edges.rounding) < deepest_->depth;
    if (!is_surely_inside && !simd::kernels::contain(*outer.tree, vertex.x(), vertex.y())) {
        return;
    }
    // Slightly more, so that which of several equally near edges is found depends on no guess.
    const double at_most =
        rounded_up(std::sqrt(guess), inner.edges.rounding + outer.edges.rounding);
    near_ = simd::kernels::find_nearer(
                *outer.tree, vertex.x(), vertex.y(),
                {near_, std::nextafter(at_most * at_most, std::numeric_limits<double>::infinity())})
                .edge;
    const geometry::NearestOnSegment nearest = nearest_on(near_);
    const double depth = std::sqrt(nearest.squared_distance);
    if (replaces(depth)) {
        deepest_ = {depth, index, vertex, nearest.point, near_};
    }
}

std::uint32_t DeepestVertex::find_candidates(const EdgesInTree& inner, const EdgesInTree& outer) {
    const std::uint32_t size = inner.edges.count;
    if (bounds_.size() < simd::padded(size)) {
        found_.resize(simd::padded(size));
        bounds_.resize(simd::padded(size));
    }
    if (inner.tree == nullptr) {
        std::iota(found_.begin(), found_.begin() + size, 0U);
        return size;
    }
    return simd::kernels::find_edges_in(*inner.tree, geometry::extent_of(outer.edges.box),
                                        found_.data());
}

std::optional<DeepVertex> DeepestVertex::find(const EdgesInTree& inner, const EdgesInTree& outer,
                                              const VertexGuess& guess) {
    deepest_.reset();
    near_ = guess.edge < outer.edges.count ? guess.edge : 0;
    if (guess.vertex < inner.edges.count) {
        take(guess.vertex, inner, outer);
    }
    const std::uint32_t count = find_candidates(inner, outer);
    bound_depths(inner, outer, count);
    const double rounding = inner.edges.rounding + outer.edges.rounding;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!deepest_ || rounded_up(std::sqrt(bounds_[i]), rounding) >= deepest_->depth) {
            take(found_[i], inner, outer);
        }
    }
    return deepest_;
}

}  // namespace nearfield::world
