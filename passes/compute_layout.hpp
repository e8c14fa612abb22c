#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/compute_layout.hpp>

#include <shaders/push.h>

#include <cstdint>
#include <vector>

namespace nearfield::passes {

/// The layout that all compute passes share, with names of the bindings of searches, and their
/// updates.
class ComputeLayout : public graph::ComputeLayout {
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
        shapes = tiles,               ///< fields of the compute technique
        scratch_of_fields = geometry,
        crowd = points,
        long_searches = points,
        // Export passes (resident outputs):
        words = tiles,
        tables = geometry,
        records = points,
        record_blocks = output,
        signed_distance_image = sign_image + 1,
        feature_id_image,
        texels,
        scratch_texels,
    };
    /// Those of the largest push constants.
    static constexpr std::uint32_t push_bytes = sizeof(plan::SearchPush);

    explicit ComputeLayout(const gpu::Device& device)
        : graph::ComputeLayout(device, push_bytes), device_(&device) {}

    /// Bindings are updated in one call: those written between begin_updates() and end_updates().
    /// The device must not be using the sets.
    void begin_updates() const;
    void end_updates() const;
    /// A part of a MappedBuffer, up to the next whole unit of 16 bytes: shaders read words as
    /// vectors of four, and of a vector that ends beyond the range some devices read zeros.
    void write_buffer(VkDescriptorSet set, Binding binding, VkBuffer buffer, VkDeviceSize offset,
                      VkDeviceSize bytes) const;
    /// A part of a buffer of the host's, which may end with it.
    void write_host_buffer(VkDescriptorSet set, Binding binding, VkBuffer buffer,
                           VkDeviceSize offset, VkDeviceSize bytes) const;
    void write_image(VkDescriptorSet set, Binding binding, VkImageView view) const;
    void write_storage_image(VkDescriptorSet set, Binding binding, VkImageView view) const;
    void write_texels(VkDescriptorSet set, Binding binding, VkBufferView view) const;

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
};

}  // namespace nearfield::passes
