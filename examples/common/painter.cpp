#include "painter.hpp"

#include <examples/painter_frag.hpp>
#include <examples/painter_vert.hpp>

#include <array>
#include <cstddef>
#include <cstring>

namespace nearfield::examples {
namespace {

/// The vertex shader's scale for pixels.
struct Scale {
    float x = 0.0F;
    float y = 0.0F;
};

ShaderModule make_shader(VkDevice device, std::span<const std::uint32_t> words) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    return create<ShaderModule>(device, vkCreateShaderModule, info, "vkCreateShaderModule");
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage, const ShaderModule& shader) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage;
    info.module = shader.get();
    info.pName = "main";
    return info;
}

PipelineLayout make_layout(VkDevice device) {
    const VkPushConstantRange scale{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Scale)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &scale;
    return create<PipelineLayout>(device, vkCreatePipelineLayout, info, "vkCreatePipelineLayout");
}

Pipeline make_pipeline(VkDevice device, VkPipelineLayout layout, VkRenderPass render_pass) {
    const ShaderModule vertex = make_shader(device, painter_vert);
    const ShaderModule fragment = make_shader(device, painter_frag);
    const std::array stages{stage(VK_SHADER_STAGE_VERTEX_BIT, vertex),
                            stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};

    const VkVertexInputBindingDescription binding{0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
    const std::array<VkVertexInputAttributeDescription, 2> attributes{
        {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, x)},
         {1, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Vertex, color)}}};
    VkPipelineVertexInputStateCreateInfo input{};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    input.pVertexAttributeDescriptions = attributes.data();

    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;

    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;

    VkPipelineRasterizationStateCreateInfo rasterization{};
    rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    rasterization.lineWidth = 1.0F;

    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;

    VkPipelineDepthStencilStateCreateInfo no_depth{};
    no_depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;

    VkPipelineColorBlendAttachmentState replace{};
    replace.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                             VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &replace;

    const std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &no_depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    info.renderPass = render_pass;
    VkPipeline pipeline = VK_NULL_HANDLE;
    require(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
            "vkCreateGraphicsPipelines");
    return {device, pipeline};
}

}  // namespace

Painter::Painter(VkPhysicalDevice physical_device, VkDevice device, VkRenderPass render_pass,
                 std::uint32_t frames_in_flight)
    : physical_device_(physical_device),
      device_(device),
      layout_(make_layout(device)),
      pipeline_(make_pipeline(device, layout_.get(), render_pass)),
      slots_(frames_in_flight) {}

void Painter::upload(std::uint32_t slot, std::span<const Vertex> triangles) {
    Slot& to = slots_.at(slot);
    if (to.vertices.size < triangles.size_bytes()) {
        to.vertices = HostBuffer(physical_device_, device_, 2 * triangles.size_bytes(),
                                 VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    }
    std::memcpy(to.vertices.mapped, triangles.data(), triangles.size_bytes());
    to.count = static_cast<std::uint32_t>(triangles.size());
}

void Painter::draw(VkCommandBuffer commands, std::uint32_t slot, VkExtent2D extent) const {
    const Slot& from = slots_.at(slot);
    const auto width = static_cast<float>(extent.width);
    const auto height = static_cast<float>(extent.height);
    const VkViewport viewport{0.0F, 0.0F, width, height, 0.0F, 1.0F};
    const VkRect2D scissor{{0, 0}, extent};
    const Scale scale{2.0F / width, 2.0F / height};
    const VkBuffer buffer = from.vertices.buffer.get();
    const VkDeviceSize offset = 0;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
    vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(scale),
                       &scale);
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
    vkCmdDraw(commands, from.count, 1, 0, 0);
}

}  // namespace nearfield::examples
