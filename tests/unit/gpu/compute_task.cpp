#include <engine/gpu/pipeline.hpp>

#include <tests/unit/gpu/compute_task.hpp>
#include <tests/unit/gpu/shaders.hpp>

#include <array>

namespace nearfield::test_support {

ComputeTask::ComputeTask(const gpu::Device& device) : device_(&device) {
    make_layouts();
    pipeline_ = gpu::make_compute_pipeline(device, layout_.get(), test_shaders::double_and_add_one,
                                           "double and add one");
    make_descriptor_set();
}

void ComputeTask::make_layouts() {
    std::array<VkDescriptorSetLayoutBinding, 2> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT,
                       nullptr};
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    set_layout_ = gpu::make_object(*device_, set_info, "a test", "a test");

    VkPipelineLayoutCreateInfo layout_info{};
    layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout_info.setLayoutCount = 1;
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    layout_info.pSetLayouts = &set_layout;
    layout_ = gpu::make_object(*device_, layout_info, "a test", "a test");
}

void ComputeTask::make_descriptor_set() {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    pool_ = gpu::make_object(*device_, pool_info, "a test", "a test");

    const VkDescriptorSetLayout set_layout = set_layout_.get();
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &set_layout;
    gpu::check(device_->functions().vkAllocateDescriptorSets(device_->handle(), &info, &set_),
               "vkAllocateDescriptorSets", "a test");
}

void ComputeTask::bind(const gpu::MappedBuffer& source, const gpu::MappedBuffer& target) {
    const std::array<VkDescriptorBufferInfo, 2> buffers{{
        {source.handle(), 0, VK_WHOLE_SIZE},
        {target.handle(), 0, VK_WHOLE_SIZE},
    }};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.descriptorCount = static_cast<std::uint32_t>(buffers.size());
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = buffers.data();
    device_->functions().vkUpdateDescriptorSets(device_->handle(), 1, &write, 0, nullptr);
}

void ComputeTask::record(VkCommandBuffer commands, std::uint32_t count) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1,
                                      &set_, 0, nullptr);
    functions.vkCmdDispatch(commands, (count + 63) / 64, 1, 1);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    functions.vkCmdPipelineBarrier(
        commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
        VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &barrier, 0,
        nullptr, 0, nullptr);
}

}  // namespace nearfield::test_support
