#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <passes/compute_layout.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace nearfield::passes {

/// Descriptor sets with a pool of their own, one for each name.
class DescriptorSets {
public:
    DescriptorSets(const gpu::Device& device, const ComputeLayout& layout,
                   std::span<const char* const> names);

    [[nodiscard]] VkDescriptorSet operator[](std::size_t i) const { return sets_[i]; }

private:
    gpu::Owned<VkDescriptorPool> pool_;
    std::vector<VkDescriptorSet> sets_;  // freed with the pool
};

}  // namespace nearfield::passes
