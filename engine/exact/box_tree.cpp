#include <engine/exact/box_tree.hpp>

namespace nearfield::exact {
namespace {

constexpr std::uint32_t boxes_over(std::uint32_t count) {
    return count / BoxTree::fan_out + (count % BoxTree::fan_out != 0 ? 1 : 0);
}

}  // namespace

std::size_t BoxTree::room(std::uint32_t edges) {
    std::size_t room = 2 * padded(boxes_over(edges));
    std::uint32_t count = edges;
    do {
        count = boxes_over(count);
        room += 4 * padded(count);
    } while (count > fan_out);
    return room;
}

BoxTree::BoxTree(const EdgeArrays& edges, const double* boxes) : edges_(edges) {
    std::uint32_t count = boxes_over(edges.count);
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

}  // namespace nearfield::exact
