#include <engine/localize/lazy_tree.hpp>

#include <array>

namespace nearfield::localize {

void LazyTree::plant(const geometry::TransformedPolygon& polygon, std::uint32_t height,
                     BoundingVolume volume) {
    hierarchy_.emplace(polygon, height, volume);
    volume_ = volume;
    nodes_.assign(1, hierarchy_->root());
    halves_.assign(1, unknown);
}

std::uint32_t LazyTree::first_half(std::uint32_t index) {
    if (halves_[index] == unknown) {
        halves_[index] = static_cast<std::uint32_t>(nodes_.size());
        const std::array<Node, 2> halves = hierarchy_->halves(nodes_[index]);
        nodes_.insert(nodes_.end(), halves.begin(), halves.end());
        halves_.insert(halves_.end(), 2, unknown);
    }
    return halves_[index];
}

}  // namespace nearfield::localize
