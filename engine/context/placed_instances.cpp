#include <engine/context/placed_instances.hpp>
#include <engine/localize/hierarchy.hpp>

namespace nearfield {

void PlacedInstances::reset(std::uint32_t count) {
    for (Entry& entry : entries_) {
        entry.moves = not_placed;
    }
    while (entries_.size() < count) {
        entries_.emplace_back();
    }
}

const PlacedInstance& PlacedInstances::at(std::uint32_t number,
                                          const DeviceInstances& instances) const {
    Entry& entry = entries_[number];
    const DeviceInstances::Entry& instance = instances[number];
    if (entry.moves.load(std::memory_order_acquire) != instance.moves) {
        const std::lock_guard lock(placing_);
        if (entry.moves.load(std::memory_order_relaxed) != instance.moves) {
            const geometry::TransformedPolygon placed(
                *instances.polygon_of(instance.instance.shape), instance.instance.pose);
            entry.placed.emplace(
                PlacedInstance{placed, localize::placement_rounding(placed, placed.box())});
            entry.moves.store(instance.moves, std::memory_order_release);
        }
    }
    return *entry.placed;
}

}  // namespace nearfield
