#include <engine/narrowphase/brute_force.hpp>
#include <engine/narrowphase/nearest_points.hpp>

namespace nearfield::narrowphase {

void NearestPoints::make_room(std::size_t points, std::size_t edges) {
    constexpr std::size_t arrays_of_numbers = 6;
    constexpr std::size_t arrays_of_indices = 2;
    const std::size_t room = simd::padded(points) + simd::max_lanes;
    if (numbers_.size() < arrays_of_numbers * room) {
        numbers_.resize(arrays_of_numbers * room);
    }
    if (indices_.size() < arrays_of_indices * room) {
        indices_.resize(arrays_of_indices * room);
    }
    if (near_.size() < simd::padded(edges)) {
        near_.resize(simd::padded(edges));
    }
    const auto numbers = [&](std::size_t array) { return numbers_.data() + array * room; };
    arrays_ = {numbers(0), numbers(1), numbers(2),      numbers(3),
               numbers(4), numbers(5), indices_.data(), indices_.data() + room};
}

void NearestPoints::find(const simd::PointArrays& points, const simd::TransformedEdges& edges,
                         double margin) {
    make_room(points.count, edges.count);
    points_ = points;
    edges_ = &edges;
    margin_ = margin;
    if (is_small(edges)) {
        simd::kernels::find_nearest_of(points, edges, margin, near_.data(), arrays_);
    } else {
        boundary_.set(edges);
        simd::kernels::find_nearest_of(points, edges.tree(), margin, near_.data(), division_,
                                       arrays_);
    }
}

bool NearestPoints::has_no_rival(std::size_t i, double limit) {
    const auto nearest_on = [&](std::uint32_t edge) {
        return geometry::nearest_on_segment({points_.x[i], points_.y[i]}, edges_->start(edge),
                                            edges_->end(edge));
    };
    const NearestPoint nearest{arrays_.edge[i], nearest_on(arrays_.edge[i])};
    if (arrays_.third_squared[i] > simd::beyond_rounding(limit)) {
        return !is_rival(nearest_on(arrays_.second[i]), nearest.on_edge, limit);
    }
    const geometry::Vector point(points_.x[i], points_.y[i]);
    return is_small(*edges_) ? narrowphase::is_unique(*edges_, point, nearest, margin_)
                             : boundary_.is_unique(point, nearest, margin_);
}

}  // namespace nearfield::narrowphase
