#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/plan/round.hpp>

#include <algorithm>
#include <cstdint>

namespace nearfield::passes {

/// The one layout of all compute passes: which buffers and images they read and write. Bindings as
/// in the shaders. A fragment shader may read the output.
class ComputeLayout {
public:
    enum Binding : std::uint32_t {
        tiles,
        geometry,
        points,
        output,
        image,
        sign_image,
        summaries = points,           ///< of the collect passes
        kept_hits = geometry,         ///< of those of images
        work = tiles,                 ///< of the masks (plan::ComputeWork)
        scratch_of_masks = geometry,  ///< the compute technique's scratch memory
        blocks = tiles,               ///< of fields
        segments = geometry,
        scratch_of_blocks = points,
        // Of the passes that hand results over:
        words = tiles,
        tables = geometry,
        records = points,
        record_blocks = output,
        signed_distance_image = sign_image + 1,
        feature_id_image,
    };
    static constexpr std::uint32_t storage_buffers = 4;
    static constexpr std::uint32_t sampled_images = 2;
    static constexpr std::uint32_t storage_images = 2;
    static constexpr std::uint32_t push_bytes = 52;

    explicit ComputeLayout(const gpu::Device& device);

    [[nodiscard]] VkPipelineLayout pipeline_layout() const { return pipeline_layout_.get(); }
    [[nodiscard]] VkDescriptorSetLayout set_layout() const { return set_layout_.get(); }

    /// Points a binding elsewhere. Not while the device uses the set.
    void write_buffer(VkDescriptorSet set, Binding binding, VkBuffer buffer, VkDeviceSize offset,
                      VkDeviceSize bytes) const;
    void write_image(VkDescriptorSet set, Binding binding, VkImageView view) const;
    void write_storage_image(VkDescriptorSet set, Binding binding, VkImageView view) const;

private:
    void write_image_in(VkImageLayout layout, VkDescriptorSet set, Binding binding,
                        VkImageView view) const;

    const gpu::Device* device_;
    gpu::Owned<VkSampler> sampler_;
    gpu::Owned<VkDescriptorSetLayout> set_layout_;
    gpu::Owned<VkPipelineLayout> pipeline_layout_;
};

/// Dispatches a shader that runs one thread an element, in groups of 64, for the elements from
/// `begin` to `end`: in as many parts as the device needs. `push` is called before each part with
/// its first element.
template <class Push>
void dispatch_points(const gpu::Functions& functions, VkCommandBuffer commands, std::uint32_t begin,
                     std::uint32_t end, Push&& push) {
    constexpr std::uint64_t group_size = 64;
    // The smallest maxComputeWorkGroupCount a device may have.
    constexpr std::uint64_t most_groups = 65535;
    for (std::uint64_t first = begin; first < end; first += most_groups * group_size) {
        push(static_cast<std::uint32_t>(first));
        const std::uint64_t groups = (end - first + group_size - 1) / group_size;
        functions.vkCmdDispatch(
            commands, static_cast<std::uint32_t>(std::min<std::uint64_t>(groups, most_groups)), 1,
            1);
    }
}

/// Dispatches a shader that runs one thread a cell, in groups of 8 x 8, over a rectangle of cells.
void dispatch_cells(const gpu::Functions& functions, VkCommandBuffer commands, std::uint32_t width,
                    std::uint32_t height);
/// Dispatches a shader that runs threads in groups of 64; all in one part.
void dispatch_threads(const gpu::Functions& functions, VkCommandBuffer commands,
                      std::uint32_t count);

}  // namespace nearfield::passes
