#include <passes/drawing.hpp>
#include <passes/gradient.hpp>
#include <passes/tile_renderer.hpp>

#include <shaders/gradient_frag.hpp>
#include <shaders/tile_mesh_vert.hpp>

#include <array>
#include <functional>
#include <limits>

namespace nearfield::passes {
namespace {

constexpr float largest_half = 65504.0F;

gpu::Owned<VkPipelineLayout> make_layout(const gpu::Device& device, VkDescriptorSetLayout set) {
    const std::array<VkPushConstantRange, 2> push{
        {{draw_push_stages, 0, sizeof(plan::MeshPush)},
         {VK_SHADER_STAGE_FRAGMENT_BIT, plan::gradient_push_offset, sizeof(plan::GradientPush)}}};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = static_cast<std::uint32_t>(push.size());
    info.pPushConstantRanges = push.data();
    return gpu::make_object(device, info, "blended gradients", "nearfield gradient layout");
}

constexpr VkColorComponentFlags both = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT;

}  // namespace

Gradient::Gradient(const gpu::Device& device, const graph::ComputeLayout& layout,
                   VkRenderPass render_pass)
    : device_(&device), layout_(make_layout(device, layout.set_layout())) {
    gpu::GraphicsPipelineDescription description = describe_drawing(
        layout_.get(), render_pass, shaders::tile_mesh_vert, shaders::gradient_frag);
    description.name = "nearfield gradient shifted";
    shifted_ = gpu::make_graphics_pipeline(device, description);
    description.name = "nearfield gradient subtract";
    description.blend =
        blending(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE, VK_BLEND_OP_REVERSE_SUBTRACT, both);
    subtract_ = gpu::make_graphics_pipeline(device, description);
    description.name = "nearfield gradient multiply";
    description.blend =
        blending(VK_BLEND_FACTOR_ZERO, VK_BLEND_FACTOR_SRC_COLOR, VK_BLEND_OP_ADD, both);
    multiply_ = gpu::make_graphics_pipeline(device, description);
}

graph::Handle Gradient::declare(TileGraph& graph, graph::Handle mesh, graph::Handle field,
                                VkExtent2D extent) const {
    return add_drawing(graph, "gradient",
                       {{graph::unbound, mesh, graph::Access::vertex_buffer},
                        {3, field, graph::Access::storage_read_in_fragment}},
                       {"gradient", device_->gradient_format(), extent}, {},
                       std::bind_front(&Gradient::record, this));
}

void Gradient::record(const graph::PassCommands& commands, const RecordContext& context) const {
    const gpu::Functions& functions = device_->functions();
    const TileRenderer renderer(*device_, layout_.get(), commands, context);
    const VkDescriptorSet set = commands.set();
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0,
                                      1, &set, 0, nullptr);
    const float largest = device_->gradient_format() == VK_FORMAT_R16G16_SFLOAT
                              ? largest_half
                              : std::numeric_limits<float>::max();
    const auto draw_all = [&](const gpu::Owned<VkPipeline>& pipeline, std::int32_t shift) {
        renderer.bind(pipeline.get());
        const plan::GradientPush push{shift, 0.5F, largest};
        functions.vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT,
                                     plan::gradient_push_offset, sizeof(push), &push);
        renderer.draw(plan::TileMeshId::gradients);
    };
    renderer.stencil(0, 0, 0);
    draw_all(shifted_, 1);
    draw_all(subtract_, -1);
    draw_all(multiply_, 0);
}

}  // namespace nearfield::passes
