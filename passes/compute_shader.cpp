#include <passes/compute_shader.hpp>

#include <shaders/search.h>

#include <array>

namespace nearfield::passes {

namespace {

/// The specialization constant of the shaders that include shapes.glsl: they read the input as
/// texels where these can address as much as a storage buffer.
std::array<VkBool32, 1> constants_of(const gpu::Device& device) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    const bool reads_texels =
        limits.maxTexelBufferElements >= limits.maxStorageBufferRange / shaders::bytes_of_unit;
    return {reads_texels ? VK_TRUE : VK_FALSE};
}

}  // namespace

ComputeShader::ComputeShader(const gpu::Device& device, const graph::ComputeLayout& layout,
                             gpu::Spirv code, const char* name)
    : functions_(&device.functions()),
      layout_(layout.pipeline_layout()),
      pipeline_(gpu::make_compute_pipeline(device, layout_, code, name, constants_of(device))) {}

void ComputeShader::bind(VkCommandBuffer commands) const {
    functions_->vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
}

void ComputeShader::bind_set(VkCommandBuffer commands, VkDescriptorSet set) const {
    functions_->vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                        &set, 0, nullptr);
}

void ComputeShader::bind(VkCommandBuffer commands, VkDescriptorSet set) const {
    bind(commands);
    bind_set(commands, set);
}

void ComputeShader::dispatch_cells(VkCommandBuffer commands, std::uint32_t width,
                                   std::uint32_t height) const {
    constexpr std::uint32_t side = shaders::field_group_side;
    functions_->vkCmdDispatch(commands, (width + side - 1) / side, (height + side - 1) / side, 1);
}

void ComputeShader::dispatch_threads(VkCommandBuffer commands, std::uint64_t count) const {
    dispatch(commands,
             static_cast<std::uint32_t>((count + shaders::group_size - 1) / shaders::group_size));
}

void ComputeShader::dispatch(VkCommandBuffer commands, std::uint32_t groups) const {
    functions_->vkCmdDispatch(commands, groups, 1, 1);
}

void ComputeShader::dispatch_indirect(VkCommandBuffer commands, VkBuffer arguments,
                                      VkDeviceSize offset) const {
    functions_->vkCmdDispatchIndirect(commands, arguments, offset);
}

void ComputeShader::push_all(VkCommandBuffer commands, const PushBytes& bytes) const {
    functions_->vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                   static_cast<std::uint32_t>(bytes.size()), bytes.data());
}

}  // namespace nearfield::passes
