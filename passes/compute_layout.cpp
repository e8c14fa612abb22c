#include <passes/compute_layout.hpp>

#include <array>

namespace nearfield::passes {
namespace {

constexpr std::uint32_t storage_buffers = 4;
constexpr std::uint32_t sampled_images = 2;

gpu::Owned<VkSampler> make_sampler(const gpu::Device& device) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.addressModeU = info.addressModeV = info.addressModeW =
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler = VK_NULL_HANDLE;
    gpu::check(device.functions().vkCreateSampler(device.handle(), &info, nullptr, &sampler),
               "vkCreateSampler", "texel fetches");
    gpu::Owned<VkSampler> owned(device, sampler);
    device.name_object(VK_OBJECT_TYPE_SAMPLER, sampler, "nearfield texel sampler");
    return owned;
}

gpu::Owned<VkDescriptorSetLayout> make_set_layout(const gpu::Device& device, VkSampler sampler) {
    std::array<VkDescriptorSetLayoutBinding, storage_buffers + sampled_images> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        const bool is_image = i >= storage_buffers;
        bindings[i].binding = i;
        bindings[i].descriptorType = is_image ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                              : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        if (i == ComputeLayout::output) {
            bindings[i].stageFlags |= VK_SHADER_STAGE_FRAGMENT_BIT;
        }
        bindings[i].pImmutableSamplers = is_image ? &sampler : nullptr;
    }
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    gpu::check(
        device.functions().vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout),
        "vkCreateDescriptorSetLayout", "compute passes");
    gpu::Owned<VkDescriptorSetLayout> owned(device, layout);
    device.name_object(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout, "nearfield compute set");
    return owned;
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
    VkPipelineLayout layout = VK_NULL_HANDLE;
    gpu::check(device.functions().vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout),
               "vkCreatePipelineLayout", "compute passes");
    gpu::Owned<VkPipelineLayout> owned(device, layout);
    device.name_object(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout, "nearfield compute layout");
    return owned;
}

gpu::Owned<VkDescriptorPool> make_pool(const gpu::Device& device) {
    constexpr std::uint32_t sets = ComputeLayout::set_count;
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, storage_buffers * sets},
         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, sampled_images * sets}}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = sets;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    gpu::check(device.functions().vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool),
               "vkCreateDescriptorPool", "compute passes");
    gpu::Owned<VkDescriptorPool> owned(device, pool);
    device.name_object(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "nearfield compute sets");
    return owned;
}

}  // namespace

ComputeLayout::ComputeLayout(const gpu::Device& device)
    : device_(&device),
      sampler_(make_sampler(device)),
      set_layout_(make_set_layout(device, sampler_.get())),
      pipeline_layout_(make_pipeline_layout(device, set_layout_.get())),
      pool_(make_pool(device)) {
    std::array<VkDescriptorSetLayout, set_count> layouts{};
    layouts.fill(set_layout_.get());
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_.get();
    info.descriptorSetCount = set_count;
    info.pSetLayouts = layouts.data();
    gpu::check(device.functions().vkAllocateDescriptorSets(device.handle(), &info, sets_),
               "vkAllocateDescriptorSets", "compute passes");
    constexpr std::array<const char*, set_count> names{"nearfield resolve points set",
                                                       "nearfield field by stencil set",
                                                       "nearfield field by color set",
                                                       "nearfield field by feature bit set",
                                                       "nearfield collect gradients set",
                                                       "nearfield collect set, stencil",
                                                       "nearfield collect set, blend",
                                                       "nearfield collect set, logic op",
                                                       "nearfield collect set, depth",
                                                       "nearfield masks set",
                                                       "nearfield blocks set"};
    for (std::uint32_t i = 0; i < set_count; ++i) {
        device.name_object(VK_OBJECT_TYPE_DESCRIPTOR_SET, sets_[i], names[i]);
    }
}

void ComputeLayout::write_buffer(VkDescriptorSet set, Binding binding, VkBuffer buffer,
                                 VkDeviceSize offset, VkDeviceSize bytes) const {
    const VkDescriptorBufferInfo info{buffer, offset, bytes};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &info;
    device_->functions().vkUpdateDescriptorSets(device_->handle(), 1, &write, 0, nullptr);
}

void ComputeLayout::write_image(VkDescriptorSet set, Binding binding, VkImageView view) const {
    const VkDescriptorImageInfo info{VK_NULL_HANDLE, view,
                                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &info;
    device_->functions().vkUpdateDescriptorSets(device_->handle(), 1, &write, 0, nullptr);
}

void dispatch_tile(const gpu::Functions& functions, VkCommandBuffer commands,
                   const plan::TileDraw& tile) {
    constexpr std::uint32_t side = 8;
    functions.vkCmdDispatch(commands, (tile.width + side - 1) / side,
                            (tile.height + side - 1) / side, 1);
}

}  // namespace nearfield::passes
