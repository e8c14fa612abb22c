#pragma once

#include <engine/context/device_instances.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

namespace nearfield {

/// An instance at its pose, in double precision.
struct PlacedInstance {
    geometry::TransformedPolygon polygon;
    double rounding = 0.0;  ///< of its vertices: localize::placement_rounding
};

/// The instances that the device names, placed when they are first needed; any number of threads
/// may need them at the same time.
class PlacedInstances {
public:
    /// Forgets all of them, and makes room for so many.
    void reset(std::uint32_t count);
    /// Places it anew if it has moved since.
    [[nodiscard]] const PlacedInstance& at(std::uint32_t number,
                                           const DeviceInstances& instances) const;

private:
    struct Entry {
        std::optional<PlacedInstance> placed;
        std::atomic<std::uint64_t> moves = not_placed;  // of the instance when it was placed
    };
    static constexpr std::uint64_t not_placed = UINT64_MAX;

    mutable std::deque<Entry> entries_;  // which stay where they are
    mutable std::mutex placing_;
};

}  // namespace nearfield
