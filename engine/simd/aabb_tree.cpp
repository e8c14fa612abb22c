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

}  // namespace nearfield::simd
