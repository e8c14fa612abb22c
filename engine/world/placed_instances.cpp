#include <engine/geometry/hierarchy.hpp>
#include <engine/world/placed_instances.hpp>

namespace nearfield {

void PlacedInstances::reset(std::uint32_t count) {
    if (room_ < count) {
        room_ = 0;
        entries_ = std::make_unique<Entry[]>(count);
        room_ = count;
        return;
    }
    for (std::uint32_t i = 0; i < room_; ++i) {
        entries_[i].moves = not_placed;
    }
}

void PlacedInstances::place(std::uint32_t number, const DeviceInstances& instances) const {
    const std::lock_guard lock(placing_);
    Entry& entry = entries_[number];
    const std::uint64_t moves = instances.moves(number);
    if (entry.moves.load(std::memory_order_relaxed) == moves) {
        return;
    }
    const DeviceInstances::Entry& instance = instances[number];
    const geometry::TransformedPolygon placed(*instances.polygon_of(instance.instance.shape),
                                              instance.instance.pose);
    entry.placed.emplace(PlacedInstance{placed, geometry::placement_rounding(placed, placed.box()),
                                        instance.handle});
    entry.moves.store(moves, std::memory_order_release);
}

}  // namespace nearfield
