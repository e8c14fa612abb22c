#include <passes/compute_layout.hpp>

#include <shaders/search.h>

#include <array>

namespace nearfield::passes {
namespace {

gpu::Owned<VkSampler> make_sampler(const gpu::Device& device) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.addressModeU = info.addressModeV = info.addressModeW =
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    return gpu::make_object(device, info, "texel fetches", "nearfield texel sampler");
}

VkDescriptorType type_of(std::uint32_t binding) {
    if (binding < ComputeLayout::storage_buffers) {
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    if (binding < ComputeLayout::storage_buffers + ComputeLayout::sampled_images) {
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    }
    return binding < ComputeLayout::texels ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                                           : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
}

gpu::Owned<VkDescriptorSetLayout> make_set_layout(const gpu::Device& device, VkSampler sampler) {
    std::array<VkDescriptorSetLayoutBinding, ComputeLayout::bindings> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = type_of(i);
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        if (i == ComputeLayout::output) {
            bindings[i].stageFlags |= VK_SHADER_STAGE_FRAGMENT_BIT;
        }
        bindings[i].pImmutableSamplers =
            type_of(i) == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER ? &sampler : nullptr;
    }
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    return gpu::make_object(device, info, "compute passes", "nearfield compute set");
}

gpu::Owned<VkPipelineLayout> make_pipeline_layout(const gpu::Device& device,
                                                  VkDescriptorSetLayout set_layout) {
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, ComputeLayout::push_bytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    return gpu::make_object(device, info, "compute passes", "nearfield compute layout");
}

}  // namespace

ComputeLayout::ComputeLayout(const gpu::Device& device)
    : device_(&device),
      sampler_(make_sampler(device)),
      set_layout_(make_set_layout(device, sampler_.get())),
      pipeline_layout_(make_pipeline_layout(device, set_layout_.get())) {}

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
