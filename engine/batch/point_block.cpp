#include <engine/batch/point_block.hpp>

#include <cmath>

namespace nearfield::batch {

void PointBlock::enter(std::uint32_t edge) {
    const geometry::Polygon& polygon = b_->polygon();
    if (edge < ring_begin_ || edge >= ring_end_) {
        const std::uint32_t ring = polygon.ring_of(edge);
        ring_begin_ = polygon.ring_begin(ring);
        ring_end_ = polygon.ring_end(ring);
    }
    const auto after = [this](std::uint32_t vertex) {
        return vertex + 1 == ring_end_ ? ring_begin_ : vertex + 1;
    };
    edge_ = edge;
    after_edge_ = after(edge);
    const std::array<std::uint32_t, vertices> numbers{
        edge == ring_begin_ ? ring_end_ - 1 : edge - 1, edge, after_edge_, after(after_edge_)};
    for (std::size_t k = 0; k < vertices; ++k) {
        const geometry::Vector vertex = b_->vertex(numbers[k]);
        x_of_vertex_[k] = vertex.x();
        y_of_vertex_[k] = vertex.y();
    }
}

void PointBlock::find(bool with_neighbours) {
    simd::NeighbourArrays edges;
    for (std::size_t k = 0; k < vertices; ++k) {
        edges.x[k] = vertex_x_[k].data();
        edges.y[k] = vertex_y_[k].data();
    }
    simd::kernels::find_nearest_of_neighbours(
        {count_, x_.data(), y_.data()}, edges, with_neighbours,
        {nearest_x_.data(), nearest_y_.data(), distance_.data(), parameter_.data(),
         neighbour_.data()});
    if (with_neighbours) {
        take_neighbours();
    }
}

void PointBlock::take_neighbours() {
    const geometry::Polygon& polygon = b_->polygon();
    for (std::uint32_t i = 0; i < count_; ++i) {
        if (neighbour_[i] == 0.0) {
            continue;
        }
        edge_of_[i] = neighbour_[i] < 0.0 ? polygon.previous(edge_of_[i]) : after_[i];
        after_[i] = polygon.next(edge_of_[i]);
    }
}

void PointBlock::set(std::uint32_t i, const narrowphase::NearestPoint& nearest) {
    edge_of_[i] = nearest.edge;
    after_[i] = b_->polygon().next(nearest.edge);
    nearest_x_[i] = nearest.on_edge.point.x();
    nearest_y_[i] = nearest.on_edge.point.y();
    distance_[i] = std::sqrt(nearest.on_edge.squared_distance);
    parameter_[i] = nearest.on_edge.parameter;
}

}  // namespace nearfield::batch
