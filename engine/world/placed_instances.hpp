#pragma once

#include <engine/base/prefetch.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/world/device_instances.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

namespace nearfield {

/// An instance at its pose, in double precision.
struct PlacedInstance {
    geometry::TransformedPolygon polygon;
    double rounding = 0.0;  ///< of its vertices: geometry::placement_rounding
    InstanceHandle handle;  ///< in the world
};

/// The instances that the device names, placed when they are first needed; any number of threads
/// may need them at the same time.
class PlacedInstances {
public:
    /// Forgets all of them, and makes room for so many.
    void reset(std::uint32_t count);
    /// Places it anew if it has moved since.
    [[nodiscard]] const PlacedInstance& at(std::uint32_t number,
                                           const DeviceInstances& instances) const {
        Entry& entry = entries_[number];
        if (entry.moves.load(std::memory_order_acquire) != instances.moves(number)) {
            place(number, instances);
        }
        return *entry.placed;
    }
    /// Says that it will be needed soon.
    void prefetch(std::uint32_t number) const {
        const auto* const entry = reinterpret_cast<const std::byte*>(&entries_[number]);
        nearfield::prefetch(entry);
        nearfield::prefetch(entry + cache_line);
    }

private:
    static constexpr std::uint64_t not_placed = UINT64_MAX;
    static constexpr std::size_t cache_line = 64;
    struct alignas(cache_line) Entry {
        std::atomic<std::uint64_t> moves = not_placed;  // of the instance when it was placed
        std::optional<PlacedInstance> placed;
    };

    void place(std::uint32_t number, const DeviceInstances& instances) const;

    std::unique_ptr<Entry[]> entries_;
    std::uint32_t room_ = 0;
    mutable std::mutex placing_;
};

}  // namespace nearfield
