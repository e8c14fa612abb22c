#include <passes/compute_layout.hpp>

#include <shaders/search.h>

namespace nearfield::passes {

void ComputeLayout::write_buffer(VkDescriptorSet set, Binding binding, VkBuffer buffer,
                                 VkDeviceSize offset, VkDeviceSize bytes) const {
    // MappedBuffer's sizes are multiples of this unit.
    constexpr VkDeviceSize unit = plan::bytes_of_unit;
    write_host_buffer(set, binding, buffer, offset, (bytes + unit - 1) / unit * unit);
}

void ComputeLayout::write_host_buffer(VkDescriptorSet set, Binding binding, VkBuffer buffer,
                                      VkDeviceSize offset, VkDeviceSize bytes) const {
    updates_.push_back({set, binding, {buffer, offset, bytes}, {}, VK_NULL_HANDLE});
}

void ComputeLayout::write_image(VkDescriptorSet set, Binding binding, VkImageView view) const {
    write_image_in(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, set, binding, view);
}

void ComputeLayout::write_storage_image(VkDescriptorSet set, Binding binding,
                                        VkImageView view) const {
    write_image_in(VK_IMAGE_LAYOUT_GENERAL, set, binding, view);
}

void ComputeLayout::write_image_in(VkImageLayout layout, VkDescriptorSet set, Binding binding,
                                   VkImageView view) const {
    updates_.push_back({set, binding, {}, {VK_NULL_HANDLE, view, layout}, VK_NULL_HANDLE});
}

void ComputeLayout::write_texels(VkDescriptorSet set, Binding binding, VkBufferView view) const {
    updates_.push_back({set, binding, {}, {}, view});
}

void ComputeLayout::begin_updates() const {
    updates_.clear();
}

void ComputeLayout::end_updates() const {
    writes_.clear();
    for (const Update& update : updates_) {
        VkWriteDescriptorSet& write = writes_.emplace_back();
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = update.set;
        write.dstBinding = update.binding;
        write.descriptorCount = 1;
        write.descriptorType = type_of(update.binding);
        if (write.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
            write.pBufferInfo = &update.buffer;
        } else if (write.descriptorType == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) {
            write.pTexelBufferView = &update.texels;
        } else {
            write.pImageInfo = &update.image;
        }
    }
    device_->functions().vkUpdateDescriptorSets(
        device_->handle(), static_cast<std::uint32_t>(writes_.size()), writes_.data(), 0, nullptr);
}

}  // namespace nearfield::passes
