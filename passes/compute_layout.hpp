#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/plan/round.hpp>
#include <nearfield/query.hpp>

#include <cstdint>

namespace nearfield::passes {

/// The one layout of all compute passes, and their descriptor sets: which buffers and images they
/// read and write. Bindings as in the shaders.
class ComputeLayout {
public:
    enum Binding : std::uint32_t {
        tiles,
        geometry,
        points,
        output,
        image,
        sign_image,
        summaries = points,  ///< of the collect passes
    };
    static constexpr std::uint32_t set_count = 2 + intersection_strategies;
    static constexpr std::uint32_t push_bytes = 8;

    explicit ComputeLayout(const gpu::Device& device);

    [[nodiscard]] VkPipelineLayout pipeline_layout() const { return pipeline_layout_.get(); }
    [[nodiscard]] VkDescriptorSet set(std::uint32_t index) const { return sets_[index]; }

    /// Points a binding elsewhere. Not while the device uses the set.
    void write_buffer(VkDescriptorSet set, Binding binding, VkBuffer buffer, VkDeviceSize offset,
                      VkDeviceSize bytes) const;
    void write_image(VkDescriptorSet set, Binding binding, VkImageView view) const;

private:
    const gpu::Device* device_;
    gpu::Owned<VkSampler> sampler_;
    gpu::Owned<VkDescriptorSetLayout> set_layout_;
    gpu::Owned<VkPipelineLayout> pipeline_layout_;
    gpu::Owned<VkDescriptorPool> pool_;
    VkDescriptorSet sets_[set_count]{};  // owned by the pool
};

/// Dispatches a shader that runs one thread a cell, in groups of 8 x 8, over a tile.
void dispatch_tile(const gpu::Functions& functions, VkCommandBuffer commands,
                   const plan::TileDraw& tile);

}  // namespace nearfield::passes
