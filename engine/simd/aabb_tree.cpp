#include <engine/simd/aabb_tree.hpp>

namespace nearfield::simd {

std::size_t AabbTree::room(std::uint32_t lowest) {
    std::size_t room = 2 * padded(lowest) + 4 * padded(lowest);
    for (std::uint32_t count = lowest; count > fan_out;) {
        count = boxes_over(count);
        room += 4 * padded(count);
    }
    return room;
}

AabbTree::AabbTree(const EdgeArrays& edges, std::span<const EdgeRange> pieces, const double* boxes,
                   const EdgesOnDemand* on_demand)
    : edges_(edges), pieces_(pieces), on_demand_(on_demand) {
    std::uint32_t count =
        pieces.empty() ? boxes_over(edges.count) : static_cast<std::uint32_t>(pieces.size());
    ring_starts_ = {count, boxes, boxes + padded(count)};
    boxes += 2 * padded(count);
    for (;; ++top_level_) {
        const std::size_t length = padded(count);
        levels_[top_level_] = {count, boxes, boxes + length, boxes + 2 * length,
                               boxes + 3 * length};
        boxes += 4 * length;
        if (count <= fan_out) {
            return;
        }
        count = boxes_over(count);
    }
}

std::array<geometry::Vector, 4> AabbTree::corners(std::uint32_t level, std::uint32_t i) const {
    if (on_demand_ != nullptr) {
        return on_demand_->corners(level, i);
    }
    const Extent of = box(level, i);
    return {geometry::Vector(of.low_x, of.low_y), geometry::Vector(of.high_x, of.low_y),
            geometry::Vector(of.high_x, of.high_y), geometry::Vector(of.low_x, of.high_y)};
}

}  // namespace nearfield::simd
