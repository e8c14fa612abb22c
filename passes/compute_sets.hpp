#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

#include <array>
#include <cstddef>

namespace nearfield::passes {

/// The descriptor sets of one round: all that its compute passes use, one for each that binds
/// something else. Rounds that may be under way at the same time have each their own.
class ComputeSets {
public:
    ComputeSets(const gpu::Device& device, const ComputeLayout& layout);

    /// Has the passes use these sets.
    void hand_to(Frame& frame) const;

private:
    static constexpr std::size_t count = 5 + sign_encodings + intersection_strategies;

    gpu::Owned<VkDescriptorPool> pool_;
    std::array<VkDescriptorSet, count> sets_{};  // owned by the pool
};

}  // namespace nearfield::passes
