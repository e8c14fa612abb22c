#include <passes/color_fill.hpp>
#include <passes/drawing.hpp>
#include <passes/tile_renderer.hpp>

#include <shaders/color_frag.hpp>
#include <shaders/mesh_vert.hpp>

#include <functional>

namespace nearfield::passes {
namespace {

constexpr std::uint32_t black = 0;
constexpr std::uint32_t white_everywhere = 0xffffffff;

}  // namespace

ColorFill::ColorFill(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass)
    : device_(&device), layout_(layout) {
    gpu::GraphicsPipelineDescription description =
        describe_drawing(layout, render_pass, shaders::mesh_vert, shaders::color_frag);

    description.name = "nearfield white clear";
    clear_ = gpu::make_graphics_pipeline(device, description);

    // Drawing white replaces a colour by one minus that colour.
    description.name = "nearfield white parity";
    description.blend = blending(VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR, VK_BLEND_FACTOR_ZERO,
                                 VK_BLEND_OP_ADD, VK_COLOR_COMPONENT_R_BIT);
    parity_ = gpu::make_graphics_pipeline(device, description);
}

graph::Handle ColorFill::declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent) const {
    return add_drawing(graph, "color fill", {{graph::unbound, mesh, graph::Access::vertex_buffer}},
                       {"white inside", white_format, extent, VK_FORMAT_R8_UINT}, {},
                       std::bind_front(&ColorFill::record, this));
}

void ColorFill::record(VkCommandBuffer commands, const RecordContext& context) const {
    const TileRenderer renderer(*device_, layout_, commands, context);
    const plan::TileMeshes& meshes = context.batch.raster.meshes;
    renderer.stencil(0, 0, 0);
    renderer.bind(clear_.get());
    renderer.draw(meshes.range(plan::rectangles_of(SignEncoding::color)), 1.0F, black);
    renderer.bind(parity_.get());
    renderer.draw(meshes.range(plan::fills_of(SignEncoding::color)), 1.0F, white_everywhere);
}

}  // namespace nearfield::passes
