#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::gpu {

/// Times the passes of one submission by a pair of timestamps each. Does nothing where the queue
/// family has no timestamps.
class Timestamps {
public:
    /// Room for `capacity` passes.
    Timestamps(const Device& device, std::uint32_t capacity);

    /// Makes room for at least so many. Not while the device uses them.
    void reserve(std::uint32_t capacity);

    /// Forgets what was measured; first in the command buffer, outside any render pass.
    void reset(VkCommandBuffer commands);
    void begin(VkCommandBuffer commands, const char* name);
    void end(VkCommandBuffer commands);

    /// After the submission's fence: adds this submission's times to `times`, pass by pass, by
    /// name. A time below 0 there stands for a pass that has not run yet.
    void collect(std::vector<PassTime>& times) const;

private:
    const Device* device_;
    Owned<VkQueryPool> pool_;
    std::uint32_t capacity_;
    std::vector<const char*> names_;
};

}  // namespace nearfield::gpu
