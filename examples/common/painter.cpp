#include "painter.hpp"

#include <examples/painter_frag.hpp>
#include <examples/painter_vert.hpp>

#include <array>
#include <cstddef>
#include <cstring>

namespace nearfield::examples {
namespace {

using ShaderStage = vk::ShaderStageFlagBits;

/// The vertex shader's scale for pixels.
struct Scale {
    float x = 0.0F;
    float y = 0.0F;
};

vk::UniqueShaderModule make_shader(vk::Device device, std::span<const std::uint32_t> words) {
    return device.createShaderModuleUnique({{}, words.size_bytes(), words.data()});
}

vk::UniquePipelineLayout make_layout(vk::Device device) {
    const vk::PushConstantRange scale(ShaderStage::eVertex, 0, sizeof(Scale));
    return device.createPipelineLayoutUnique(
        vk::PipelineLayoutCreateInfo().setPushConstantRanges(scale));
}

vk::UniquePipeline make_pipeline(vk::Device device, vk::PipelineLayout layout,
                                 vk::RenderPass render_pass) {
    const vk::UniqueShaderModule vertex = make_shader(device, painter_vert);
    const vk::UniqueShaderModule fragment = make_shader(device, painter_frag);
    const std::array stages{
        vk::PipelineShaderStageCreateInfo({}, ShaderStage::eVertex, *vertex, "main"),
        vk::PipelineShaderStageCreateInfo({}, ShaderStage::eFragment, *fragment, "main")};
    const vk::VertexInputBindingDescription binding(0, sizeof(Vertex));
    const std::array attributes{
        vk::VertexInputAttributeDescription(0, 0, vk::Format::eR32G32Sfloat, offsetof(Vertex, x)),
        vk::VertexInputAttributeDescription(1, 0, vk::Format::eR8G8B8A8Unorm,
                                            offsetof(Vertex, color))};
    const auto input = vk::PipelineVertexInputStateCreateInfo()
                           .setVertexBindingDescriptions(binding)
                           .setVertexAttributeDescriptions(attributes);
    const auto assembly = vk::PipelineInputAssemblyStateCreateInfo().setTopology(
        vk::PrimitiveTopology::eTriangleList);
    const auto viewport =
        vk::PipelineViewportStateCreateInfo().setViewportCount(1).setScissorCount(1);
    const auto rasterization = vk::PipelineRasterizationStateCreateInfo().setLineWidth(1.0F);
    const vk::PipelineMultisampleStateCreateInfo multisample;
    const vk::PipelineDepthStencilStateCreateInfo no_depth;
    using Component = vk::ColorComponentFlagBits;
    const auto replace = vk::PipelineColorBlendAttachmentState().setColorWriteMask(
        Component::eR | Component::eG | Component::eB | Component::eA);
    const auto blend = vk::PipelineColorBlendStateCreateInfo().setAttachments(replace);
    const std::array dynamic_states{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const auto dynamic = vk::PipelineDynamicStateCreateInfo().setDynamicStates(dynamic_states);
    return device
        .createGraphicsPipelineUnique({}, vk::GraphicsPipelineCreateInfo()
                                              .setStages(stages)
                                              .setPVertexInputState(&input)
                                              .setPInputAssemblyState(&assembly)
                                              .setPViewportState(&viewport)
                                              .setPRasterizationState(&rasterization)
                                              .setPMultisampleState(&multisample)
                                              .setPDepthStencilState(&no_depth)
                                              .setPColorBlendState(&blend)
                                              .setPDynamicState(&dynamic)
                                              .setLayout(layout)
                                              .setRenderPass(render_pass))
        .value;
}

}  // namespace

Painter::Painter(vk::PhysicalDevice physical_device, vk::Device device, vk::RenderPass render_pass,
                 std::uint32_t frames_in_flight)
    : physical_device_(physical_device),
      device_(device),
      layout_(make_layout(device)),
      pipeline_(make_pipeline(device, *layout_, render_pass)),
      slots_(frames_in_flight) {}

void Painter::upload(std::uint32_t slot, std::span<const Vertex> triangles) {
    Slot& to = slots_.at(slot);
    if (to.vertices.size < triangles.size_bytes()) {
        to.vertices = HostBuffer(physical_device_, device_, 2 * triangles.size_bytes(),
                                 vk::BufferUsageFlagBits::eVertexBuffer);
    }
    std::memcpy(to.vertices.mapped, triangles.data(), triangles.size_bytes());
    to.count = static_cast<std::uint32_t>(triangles.size());
}

void Painter::draw(vk::CommandBuffer commands, std::uint32_t slot, vk::Extent2D extent) const {
    const Slot& from = slots_.at(slot);
    const auto width = static_cast<float>(extent.width);
    const auto height = static_cast<float>(extent.height);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
    commands.setViewport(0, vk::Viewport(0.0F, 0.0F, width, height, 0.0F, 1.0F));
    commands.setScissor(0, vk::Rect2D({0, 0}, extent));
    commands.pushConstants<Scale>(*layout_, ShaderStage::eVertex, 0,
                                  Scale{2.0F / width, 2.0F / height});
    commands.bindVertexBuffers(0, *from.vertices.buffer, vk::DeviceSize{0});
    commands.draw(from.count, 1, 0, 0);
}

}  // namespace nearfield::examples
