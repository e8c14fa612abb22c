#include <engine/graph/compute_layout.hpp>

#include <array>

namespace nearfield::graph {
namespace {

gpu::Owned<VkSampler> make_sampler(const gpu::Device& device) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.addressModeU = info.addressModeV = info.addressModeW =
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    return gpu::make_object(device, info, "texel fetches", "nearfield texel sampler");
}

gpu::Owned<VkDescriptorSetLayout> make_set_layout(const gpu::Device& device, VkSampler sampler) {
    std::array<VkDescriptorSetLayoutBinding, ComputeLayout::bindings> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = ComputeLayout::type_of(i);
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        if (i + 1 == ComputeLayout::storage_buffers) {
            bindings[i].stageFlags |= VK_SHADER_STAGE_FRAGMENT_BIT;
        }
        bindings[i].pImmutableSamplers =
            bindings[i].descriptorType == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER ? &sampler
                                                                                    : nullptr;
    }
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    return gpu::make_object(device, info, "compute passes", "nearfield compute set");
}

gpu::Owned<VkPipelineLayout> make_pipeline_layout(const gpu::Device& device,
                                                  VkDescriptorSetLayout set_layout,
                                                  std::uint32_t push_bytes) {
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    return gpu::make_object(device, info, "compute passes", "nearfield compute layout");
}

}  // namespace

ComputeLayout::ComputeLayout(const gpu::Device& device, std::uint32_t push_bytes)
    : sampler_(make_sampler(device)),
      set_layout_(make_set_layout(device, sampler_.get())),
      pipeline_layout_(make_pipeline_layout(device, set_layout_.get(), push_bytes)) {}

VkDescriptorType ComputeLayout::type_of(std::uint32_t binding) {
    if (binding < storage_buffers) {
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    if (binding < storage_buffers + sampled_images) {
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    }
    return binding < first_texels ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                                  : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
}

}  // namespace nearfield::graph
