#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace nearfield::passes {

/// Descriptor sets of a pool to themselves, one for each name.
class DescriptorSets {
public:
    DescriptorSets(const gpu::Device& device, const ComputeLayout& layout,
                   std::span<const char* const> names);

    [[nodiscard]] VkDescriptorSet operator[](std::size_t i) const { return sets_[i]; }

private:
    gpu::Owned<VkDescriptorPool> pool_;
    std::vector<VkDescriptorSet> sets_;  // owned by the pool
};

/// The descriptor sets of one round: all that its compute passes use, one for each that binds
/// something else. Rounds that may be under way at the same time have each their own.
class ComputeSets {
public:
    ComputeSets(const gpu::Device& device, const ComputeLayout& layout);

    /// Has the passes use these sets.
    void hand_to(Frame& frame) const;

private:
    DescriptorSets sets_;
};

}  // namespace nearfield::passes
