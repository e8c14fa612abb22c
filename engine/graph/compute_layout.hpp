#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

#include <cstdint>

namespace nearfield::graph {

/// The descriptor set layout and pipeline layout that all compute passes share: first the bindings
/// of storage buffers, as many as every device has, then those of sampled images, of storage
/// images, and of texels. Fragment shaders may read the last storage buffer.
class ComputeLayout {
public:
    static constexpr std::uint32_t storage_buffers = 4;
    static constexpr std::uint32_t sampled_images = 2;
    static constexpr std::uint32_t storage_images = 2;
    static constexpr std::uint32_t texel_buffers = 2;
    static constexpr std::uint32_t first_texels = storage_buffers + sampled_images + storage_images;
    static constexpr std::uint32_t bindings = first_texels + texel_buffers;

    /// `push_bytes`: those of the largest push constants.
    ComputeLayout(const gpu::Device& device, std::uint32_t push_bytes);

    [[nodiscard]] VkPipelineLayout pipeline_layout() const { return pipeline_layout_.get(); }
    [[nodiscard]] VkDescriptorSetLayout set_layout() const { return set_layout_.get(); }
    [[nodiscard]] static VkDescriptorType type_of(std::uint32_t binding);

private:
    gpu::Owned<VkSampler> sampler_;
    gpu::Owned<VkDescriptorSetLayout> set_layout_;
    gpu::Owned<VkPipelineLayout> pipeline_layout_;
};

}  // namespace nearfield::graph
