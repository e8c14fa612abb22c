#include <passes/compute_sets.hpp>

#include <array>

namespace nearfield::passes {
namespace {

gpu::Owned<VkDescriptorPool> make_pool(const gpu::Device& device, std::uint32_t sets) {
    const std::array<VkDescriptorPoolSize, 4> sizes{
        {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, ComputeLayout::storage_buffers * sets},
         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, ComputeLayout::sampled_images * sets},
         {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, ComputeLayout::storage_images * sets},
         {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, ComputeLayout::texel_buffers * sets}}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = sets;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    return gpu::make_object(device, info, "compute passes", "nearfield compute sets");
}

}  // namespace

DescriptorSets::DescriptorSets(const gpu::Device& device, const ComputeLayout& layout,
                               std::span<const char* const> names)
    : pool_(make_pool(device, static_cast<std::uint32_t>(names.size()))), sets_(names.size()) {
    const std::vector<VkDescriptorSetLayout> layouts(names.size(), layout.set_layout());
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_.get();
    info.descriptorSetCount = static_cast<std::uint32_t>(layouts.size());
    info.pSetLayouts = layouts.data();
    gpu::check(device.functions().vkAllocateDescriptorSets(device.handle(), &info, sets_.data()),
               "vkAllocateDescriptorSets", "compute passes");
    for (std::size_t i = 0; i < names.size(); ++i) {
        device.name_object(VK_OBJECT_TYPE_DESCRIPTOR_SET, sets_[i], names[i]);
    }
}

}  // namespace nearfield::passes
