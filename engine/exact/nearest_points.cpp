#include <engine/exact/edge_by_edge.hpp>
#include <engine/exact/nearest_points.hpp>

#include <cmath>

namespace nearfield::exact {

void NearestPoints::make_room(std::size_t points, std::size_t edges) {
    constexpr std::size_t arrays_of_numbers = 6;
    constexpr std::size_t arrays_of_indices = 2;
    const std::size_t room = padded(points) + most_lanes;
    if (numbers_.size() < arrays_of_numbers * room) {
        numbers_.resize(arrays_of_numbers * room);
    }
    if (indices_.size() < arrays_of_indices * room) {
        indices_.resize(arrays_of_indices * room);
    }
    if (near_.size() < padded(edges)) {
        near_.resize(padded(edges));
    }
    const auto numbers = [&](std::size_t array) { return numbers_.data() + array * room; };
    arrays_ = {numbers(0), numbers(1), numbers(2),      numbers(3),
               numbers(4), numbers(5), indices_.data(), indices_.data() + room};
}

void NearestPoints::find(const PointArrays& points, const PlacedEdges& edges, double margin) {
    make_room(points.count, edges.count);
    points_ = points;
    edges_ = &edges;
    margin_ = margin;
    // So many points are quicker held against several edges at once than several points against
    // one.
    constexpr std::uint32_t few_points = 4;
    if (is_small(edges) && points.count <= few_points) {
        find_one_by_one();
    } else if (is_small(edges)) {
        kernels::find_nearest_of(points, edges, margin, near_.data(), arrays_);
    } else {
        boundary_.set(edges);
        kernels::find_nearest_of(points, edges.tree(), margin, near_.data(), arrays_);
    }
}

/// No more than the nearest edges: few points are asked whether they are unique.
void NearestPoints::find_one_by_one() {
    for (std::uint32_t i = 0; i < points_.count; ++i) {
        const geometry::Vector point(points_.x[i], points_.y[i]);
        const NearestPoint nearest = exact::nearest(*edges_, point);
        arrays_.x[i] = nearest.on_edge.point.x();
        arrays_.y[i] = nearest.on_edge.point.y();
        arrays_.distance[i] = std::sqrt(nearest.on_edge.squared_distance);
        arrays_.parameter[i] = nearest.on_edge.parameter;
        arrays_.second_squared[i] = arrays_.third_squared[i] = 0.0;
        arrays_.edge[i] = nearest.edge;
    }
}

bool NearestPoints::has_no_rival(std::size_t i, double limit) {
    const auto nearest_on = [&](std::uint32_t edge) {
        return geometry::nearest_on_segment({points_.x[i], points_.y[i]}, edges_->start(edge),
                                            edges_->end(edge));
    };
    const NearestPoint nearest{arrays_.edge[i], nearest_on(arrays_.edge[i])};
    if (arrays_.third_squared[i] > beyond_rounding(limit)) {
        return !is_rival(nearest_on(arrays_.second[i]), nearest.on_edge, limit);
    }
    const geometry::Vector point(points_.x[i], points_.y[i]);
    return is_small(*edges_) ? exact::is_unique(*edges_, point, nearest, margin_)
                             : boundary_.is_unique(point, nearest, margin_);
}

}  // namespace nearfield::exact
