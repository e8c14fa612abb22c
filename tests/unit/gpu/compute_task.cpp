#include <engine/gpu/pipeline.hpp>

#include <tests/unit/gpu/compute_task.hpp>

#include <array>
#include <cstdint>

namespace nearfield::test_support {
namespace {

// As glslang makes it (--target-env vulkan1.1 -g0).
// clang-format off
// #version 450
// layout(local_size_x = 64) in;
// layout(set = 0, binding = 0) readonly buffer Source { uint source[]; };
// layout(set = 0, binding = 1) writeonly buffer Target { uint target[]; };
// void main() {
//     uint i = gl_GlobalInvocationID.x;
//     if (i < target.length()) { target[i] = 2u * source[i] + 1u; }
// }
constexpr std::array<std::uint32_t, 274> double_and_add_one{
    0x07230203, 0x00010300, 0x0008000b, 0x0000002e, 0x00000000, 0x00020011, 0x00000001, 0x0006000b,
    0x00000001, 0x4c534c47, 0x6474732e, 0x3035342e, 0x00000000, 0x0003000e, 0x00000000, 0x00000001,
    0x0006000f, 0x00000005, 0x00000004, 0x6e69616d, 0x00000000, 0x0000000b, 0x00060010, 0x00000004,
    0x00000011, 0x00000040, 0x00000001, 0x00000001, 0x00040047, 0x0000000b, 0x0000000b, 0x0000001c,
    0x00040047, 0x00000011, 0x00000006, 0x00000004, 0x00040048, 0x00000012, 0x00000000, 0x00000019,
    0x00050048, 0x00000012, 0x00000000, 0x00000023, 0x00000000, 0x00030047, 0x00000012, 0x00000002,
    0x00040047, 0x00000014, 0x00000022, 0x00000000, 0x00040047, 0x00000014, 0x00000021, 0x00000001,
    0x00040047, 0x00000020, 0x00000006, 0x00000004, 0x00040048, 0x00000021, 0x00000000, 0x00000018,
    0x00050048, 0x00000021, 0x00000000, 0x00000023, 0x00000000, 0x00030047, 0x00000021, 0x00000002,
    0x00040047, 0x00000023, 0x00000022, 0x00000000, 0x00040047, 0x00000023, 0x00000021, 0x00000000,
    0x00040047, 0x0000002d, 0x0000000b, 0x00000019, 0x00020013, 0x00000002, 0x00030021, 0x00000003,
    0x00000002, 0x00040015, 0x00000006, 0x00000020, 0x00000000, 0x00040020, 0x00000007, 0x00000007,
    0x00000006, 0x00040017, 0x00000009, 0x00000006, 0x00000003, 0x00040020, 0x0000000a, 0x00000001,
    0x00000009, 0x0004003b, 0x0000000a, 0x0000000b, 0x00000001, 0x0004002b, 0x00000006, 0x0000000c,
    0x00000000, 0x00040020, 0x0000000d, 0x00000001, 0x00000006, 0x0003001d, 0x00000011, 0x00000006,
    0x0003001e, 0x00000012, 0x00000011, 0x00040020, 0x00000013, 0x0000000c, 0x00000012, 0x0004003b,
    0x00000013, 0x00000014, 0x0000000c, 0x00040015, 0x00000016, 0x00000020, 0x00000001, 0x00020014,
    0x00000019, 0x0004002b, 0x00000016, 0x0000001d, 0x00000000, 0x0004002b, 0x00000006, 0x0000001f,
    0x00000002, 0x0003001d, 0x00000020, 0x00000006, 0x0003001e, 0x00000021, 0x00000020, 0x00040020,
    0x00000022, 0x0000000c, 0x00000021, 0x0004003b, 0x00000022, 0x00000023, 0x0000000c, 0x00040020,
    0x00000025, 0x0000000c, 0x00000006, 0x0004002b, 0x00000006, 0x00000029, 0x00000001, 0x0004002b,
    0x00000006, 0x0000002c, 0x00000040, 0x0006002c, 0x00000009, 0x0000002d, 0x0000002c, 0x00000029,
    0x00000029, 0x00050036, 0x00000002, 0x00000004, 0x00000000, 0x00000003, 0x000200f8, 0x00000005,
    0x0004003b, 0x00000007, 0x00000008, 0x00000007, 0x00050041, 0x0000000d, 0x0000000e, 0x0000000b,
    0x0000000c, 0x0004003d, 0x00000006, 0x0000000f, 0x0000000e, 0x0003003e, 0x00000008, 0x0000000f,
    0x0004003d, 0x00000006, 0x00000010, 0x00000008, 0x00050044, 0x00000006, 0x00000015, 0x00000014,
    0x00000000, 0x0004007c, 0x00000016, 0x00000017, 0x00000015, 0x0004007c, 0x00000006, 0x00000018,
    0x00000017, 0x000500b0, 0x00000019, 0x0000001a, 0x00000010, 0x00000018, 0x000300f7, 0x0000001c,
    0x00000000, 0x000400fa, 0x0000001a, 0x0000001b, 0x0000001c, 0x000200f8, 0x0000001b, 0x0004003d,
    0x00000006, 0x0000001e, 0x00000008, 0x0004003d, 0x00000006, 0x00000024, 0x00000008, 0x00060041,
    0x00000025, 0x00000026, 0x00000023, 0x0000001d, 0x00000024, 0x0004003d, 0x00000006, 0x00000027,
    0x00000026, 0x00050084, 0x00000006, 0x00000028, 0x0000001f, 0x00000027, 0x00050080, 0x00000006,
    0x0000002a, 0x00000028, 0x00000029, 0x00060041, 0x00000025, 0x0000002b, 0x00000014, 0x0000001d,
    0x0000001e, 0x0003003e, 0x0000002b, 0x0000002a, 0x000200f9, 0x0000001c, 0x000200f8, 0x0000001c,
    0x000100fd, 0x00010038,
};
// clang-format on

}  // namespace

ComputeTask::ComputeTask(const gpu::Device& device) : device_(&device) {
    make_layouts();
    pipeline_ =
        gpu::make_compute_pipeline(device, layout_.get(), double_and_add_one, "double and add one");
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
