#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/plan/tile_batch.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace nearfield::passes {

/// The descriptor set layout and pipeline layout that all compute passes share. The bindings match
/// the shaders. Fragment shaders may read `output`.
class ComputeLayout {
public:
    enum Binding : std::uint32_t {
        tiles,
        geometry,
        points,
        output,
        image,
        sign_image,
        summaries = points,           ///< collect passes
        kept_hits = geometry,         ///< collect passes that read images
        work = tiles,                 ///< mask passes (plan::ComputeWork)
        scratch_of_masks = geometry,  ///< the compute technique's scratch memory
        blocks = tiles,               ///< field passes of the compute technique
        segments = geometry,
        scratch_of_blocks = points,
        // Export passes (resident outputs):
        words = tiles,
        tables = geometry,
        records = points,
        record_blocks = output,
        signed_distance_image = sign_image + 1,
        feature_id_image,
        texels,
    };
    static constexpr std::uint32_t storage_buffers = 4;
    static constexpr std::uint32_t sampled_images = 2;
    static constexpr std::uint32_t storage_images = 2;
    static constexpr std::uint32_t texel_buffers = 1;
    static constexpr std::uint32_t bindings =
        storage_buffers + sampled_images + storage_images + texel_buffers;
    static constexpr std::uint32_t push_bytes = 52;

    explicit ComputeLayout(const gpu::Device& device);

    [[nodiscard]] VkPipelineLayout pipeline_layout() const { return pipeline_layout_.get(); }
    [[nodiscard]] VkDescriptorSetLayout set_layout() const { return set_layout_.get(); }

    /// Bindings are updated in one call: those written between begin_updates() and end_updates().
    /// The device must not be using the sets.
    void begin_updates() const;
    void end_updates() const;
    void write_buffer(VkDescriptorSet set, Binding binding, VkBuffer buffer, VkDeviceSize offset,
                      VkDeviceSize bytes) const;
    void write_image(VkDescriptorSet set, Binding binding, VkImageView view) const;
    void write_storage_image(VkDescriptorSet set, Binding binding, VkImageView view) const;
    void write_texels(VkDescriptorSet set, VkBufferView view) const;

private:
    void write_image_in(VkImageLayout layout, VkDescriptorSet set, Binding binding,
                        VkImageView view) const;

    /// What a binding is to refer to.
    struct Update {
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::uint32_t binding = 0;
        VkDescriptorBufferInfo buffer{};  // or
        VkDescriptorImageInfo image{};    // or
        VkBufferView texels = VK_NULL_HANDLE;
    };

    const gpu::Device* device_;
    // Scratch memory of the updates.
    mutable std::vector<Update> updates_;
    mutable std::vector<VkWriteDescriptorSet> writes_;
    gpu::Owned<VkSampler> sampler_;
    gpu::Owned<VkDescriptorSetLayout> set_layout_;
    gpu::Owned<VkPipelineLayout> pipeline_layout_;
};

/// The minimum of maxComputeWorkGroupCount that Vulkan guarantees.
inline constexpr std::uint32_t max_groups = 65535;

/// Dispatches a shader with one thread per element, in workgroups of 64, for the elements from
/// `begin` to `end`, in as many dispatches as the device's limits require. `push(first)` is called
/// before each with its first element.
template <class Push>
void dispatch_points(const gpu::Functions& functions, VkCommandBuffer commands, std::uint32_t begin,
                     std::uint32_t end, Push&& push) {
    constexpr std::uint64_t group_size = 64;
    for (std::uint64_t first = begin; first < end; first += max_groups * group_size) {
        push(static_cast<std::uint32_t>(first));
        const std::uint64_t groups = (end - first + group_size - 1) / group_size;
        functions.vkCmdDispatch(
            commands, static_cast<std::uint32_t>(std::min<std::uint64_t>(groups, max_groups)), 1,
            1);
    }
}

/// Dispatches a workgroup for each plan::CellGroup of a list, in as many dispatches as the device's
/// limits require. `push(first)` is called before each with the position of its first group.
template <class Push>
void dispatch_groups(const gpu::Functions& functions, VkCommandBuffer commands,
                     const plan::TileBatch& round, std::size_t list, Push&& push) {
    const std::uint32_t begin = round.first_group(list);
    const auto end = begin + static_cast<std::uint32_t>(round.groups[list].size());
    for (std::uint32_t first = begin; first < end; first += max_groups) {
        push(first);
        functions.vkCmdDispatch(commands, std::min(end - first, max_groups), 1, 1);
    }
}

/// Dispatches a shader with one thread per cell, in workgroups of 8 x 8, over a rectangle of cells.
void dispatch_cells(const gpu::Functions& functions, VkCommandBuffer commands, std::uint32_t width,
                    std::uint32_t height);
/// Dispatches `count` threads in workgroups of 64, in a single dispatch.
void dispatch_threads(const gpu::Functions& functions, VkCommandBuffer commands,
                      std::uint32_t count);

}  // namespace nearfield::passes
