#include <engine/simd/aabb_tree.hpp>
#include <engine/simd/edges_on_demand.hpp>

#include <algorithm>
#include <thread>

namespace nearfield::simd {

using geometry::Polygon;
using geometry::Vector;

void EdgesOnDemand::begin(const geometry::TransformedPolygon& placed,
                          const geometry::EdgeBoxes& boxes, const Arrays& arrays) {
    polygon_.emplace(placed);
    boxes_ = &boxes;
    arrays_ = arrays;
    allowance_ = geometry::box_allowance(placed);
    std::uint32_t count = AabbTree::boxes_over(placed.polygon().size());
    std::size_t states = count;
    double* low_x = arrays.boxes;
    for (std::uint32_t level = 0; level <= boxes.top_level(); ++level) {
        levels_[level] = {states, low_x, padded(count)};
        low_x += 4 * padded(count);
        count = AabbTree::boxes_over(count);
        states += count;
    }
    placed_state_ += 2;
    if (states > room_ || placed_state_ < 2) {
        states_ = std::make_unique<std::atomic<std::uint32_t>[]>(std::max(states, room_));
        room_ = std::max(states, room_);
        placed_state_ = 2;
    }
}

template <class Place>
void EdgesOnDemand::place_once(std::size_t state, const Place& place) const {
    std::atomic<std::uint32_t>& own = states_[state];
    std::uint32_t seen = own.load(std::memory_order_acquire);
    while (seen != placed_state_) {
        if (seen == placed_state_ - 1) {
            std::this_thread::yield();
            seen = own.load(std::memory_order_acquire);
        } else if (own.compare_exchange_weak(seen, placed_state_ - 1, std::memory_order_acquire)) {
            place();
            own.store(placed_state_, std::memory_order_release);
            return;
        }
    }
}

void EdgesOnDemand::place_run(std::uint32_t lowest) const {
    place_once(lowest, [&] { write_run(lowest); });
}

void EdgesOnDemand::write_run(std::uint32_t lowest) const {
    const Polygon& polygon = polygon_->polygon();
    const std::uint32_t first = AabbTree::fan_out * lowest;
    const std::uint32_t end = std::min(first + AabbTree::fan_out, polygon.size());
    const bool is_one_chain =
        end < polygon.size() &&
        (polygon.ring_count() == 1 || polygon.ring_of(first) == polygon.ring_of(end));
    double* const start_x = arrays_.edges + first;
    const std::size_t stride = arrays_.edge_stride;
    if (is_one_chain) {
        kernels::place_edges(polygon.vertices().data() + first, polygon_->placement(), start_x,
                             stride);
        return;
    }
    const auto write = [&](std::uint32_t i, const Vector& start, const Vector& to) {
        start_x[i] = start.x();
        start_x[stride + i] = start.y();
        start_x[2 * stride + i] = to.x();
        start_x[3 * stride + i] = to.y();
    };
    for (std::uint32_t edge = first; edge < end; ++edge) {
        write(edge - first, polygon_->vertex(edge), polygon_->vertex(polygon.next(edge)));
    }
    const Vector last = polygon_->vertex(polygon.next(end - 1));
    for (std::uint32_t i = end - first; i < AabbTree::fan_out; ++i) {
        write(i, last, last);  // the padding
    }
}

void EdgesOnDemand::place_group(std::uint32_t level, std::uint32_t group) const {
    const Level& own = levels_[level];
    place_once(own.states + group, [&] {
        kernels::place_boxes(boxes_->group(level, group), polygon_->placement(), allowance_,
                             own.low_x + std::size_t{AabbTree::fan_out} * group, own.stride);
    });
}

void EdgesOnDemand::place_all() const {
    const std::uint32_t count = AabbTree::boxes_over(polygon_->polygon().size());
    for (std::uint32_t lowest = 0; lowest < count; ++lowest) {
        place_edges(lowest);
    }
}

std::array<Vector, 4> EdgesOnDemand::corners(std::uint32_t level, std::uint32_t box) const {
    const geometry::EdgeBoxes::Group& own = group(level, box / AabbTree::fan_out);
    const std::uint32_t i = box % AabbTree::fan_out;
    const Vector centre = polygon_->to_world({own.x[i], own.y[i]});
    const Vector unit = polygon_->rotation() * Vector(own.along_x[i], own.along_y[i]);
    const Vector along = (own.half_along[i] + allowance_) * unit;
    const Vector across = (own.half_across[i] + allowance_) * Vector(-unit.y(), unit.x());
    return {Vector(centre - along - across), Vector(centre + along - across),
            Vector(centre + along + across), Vector(centre - along + across)};
}

std::uint32_t EdgesOnDemand::ring_begin(std::uint32_t lowest) const {
    const Polygon& polygon = polygon_->polygon();
    const std::uint32_t begin =
        polygon.ring_count() == 1 ? 0
                                  : polygon.ring_begin(polygon.ring_of(AabbTree::fan_out * lowest));
    place_edges(begin / AabbTree::fan_out);
    return begin;
}

}  // namespace nearfield::simd
