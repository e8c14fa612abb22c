#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/submission.hpp>

#include <cstdint>

namespace nearfield::test_support {

/// Computes target[i] = 2 * source[i] + 1 on the device: the smallest work with a visible effect.
class ComputeTask {
public:
    explicit ComputeTask(const gpu::Device& device);

    /// The device must not be using either buffer.
    void bind(const gpu::MappedBuffer& source, const gpu::MappedBuffer& target);
    /// Records the dispatch and makes its result visible to the host.
    void record(VkCommandBuffer commands, std::uint32_t count) const;

private:
    void make_layouts();
    void make_descriptor_set();

    const gpu::Device* device_;
    gpu::Owned<VkDescriptorSetLayout> set_layout_;
    gpu::Owned<VkPipelineLayout> layout_;
    gpu::Owned<VkPipeline> pipeline_;
    gpu::Owned<VkDescriptorPool> pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;  // owned by the pool
};

}  // namespace nearfield::test_support
