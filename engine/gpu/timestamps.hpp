#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::gpu {

/// Times the passes of one submission with a pair of timestamps each. Does nothing if the queue
/// family has no timestamps, or if they are turned off.
class Timestamps {
public:
    /// Reserves timestamps for `capacity` passes, unless they are turned off (`on`).
    Timestamps(const Device& device, std::uint32_t capacity, bool on = true);

    /// Grows to at least `capacity` passes. Must not be called while the device uses the
    /// timestamps.
    void reserve(std::uint32_t capacity);

    /// Discards earlier measurements; first in the command buffer, outside any render pass.
    void reset(VkCommandBuffer commands);
    void begin(VkCommandBuffer commands, const char* name);
    void end(VkCommandBuffer commands);

    /// Call after the submission's fence: adds this submission's times to `times`, pass by pass, by
    /// name. A negative time in `times` marks a pass that has not run yet.
    void collect(std::vector<PassTime>& times) const;

private:
    const Device* device_;
    bool on_;
    Owned<VkQueryPool> pool_;
    std::uint32_t capacity_;
    std::vector<const char*> names_;
};

}  // namespace nearfield::gpu
