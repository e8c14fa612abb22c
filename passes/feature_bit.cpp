#include <passes/cone_mesh.hpp>
#include <passes/drawing.hpp>
#include <passes/feature_bit.hpp>
#include <passes/stencil_pipelines.hpp>
#include <passes/tile_renderer.hpp>

#include <shaders/color_frag.hpp>
#include <shaders/color_in_tile_frag.hpp>
#include <shaders/mesh_vert.hpp>
#include <shaders/tile_mesh_vert.hpp>

#include <functional>

namespace nearfield::passes {
namespace {

constexpr std::uint32_t no_feature_outside = plan::max_signed_features;
constexpr std::uint32_t all_bits = 0xffffffff;

constexpr VkColorComponentFlags id_bytes =
    VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT;

}  // namespace

FeatureBit::FeatureBit(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass)
    : device_(&device), layout_(layout) {
    gpu::GraphicsPipelineDescription description =
        describe_drawing(layout, render_pass, shaders::mesh_vert, shaders::color_frag);
    description.depth_test = true;

    description.name = "nearfield signed feature clear";
    description.depth_compare = VK_COMPARE_OP_ALWAYS;
    clear_ = gpu::make_graphics_pipeline(device, description);

    description.name = "nearfield signed feature parity";
    description.depth_test = false;
    description.blend = blending(VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA, VK_BLEND_FACTOR_ZERO,
                                 VK_BLEND_OP_ADD, VK_COLOR_COMPONENT_A_BIT);
    parity_ = gpu::make_graphics_pipeline(device, description);

    VkPipelineColorBlendAttachmentState only_ids{};
    only_ids.colorWriteMask = id_bytes;
    description.name = "nearfield signed feature mesh";
    description.vertex_shader = shaders::tile_mesh_vert;
    description.fragment_shader = shaders::color_in_tile_frag;
    description.depth_test = true;
    description.depth_compare = VK_COMPARE_OP_LESS;
    description.blend = only_ids;
    draw_ = gpu::make_graphics_pipeline(device, description);
}

graph::Handle FeatureBit::declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent) const {
    return add_drawing(graph, "signed cone mesh",
                       {{graph::unbound, mesh, graph::Access::vertex_buffer}},
                       {"signed features", signed_feature_format, extent, number_format},
                       {"distance under signed features", distance_depth_format, extent},
                       std::bind_front(&FeatureBit::record, this));
}

void FeatureBit::record(VkCommandBuffer commands, const RecordContext& context) const {
    const TileRenderer renderer(*device_, layout_, commands, context);
    const plan::TileMeshes& meshes = context.batch.raster.meshes;
    renderer.stencil(0, 0, 0);
    renderer.bind(clear_.get());
    renderer.draw(meshes.range(plan::rectangles_of(SignEncoding::feature_bit)), 1.0F,
                  no_feature_outside);
    renderer.bind(parity_.get());
    renderer.draw(meshes.range(plan::fills_of(SignEncoding::feature_bit)), 1.0F, all_bits);
    renderer.bind(draw_.get());
    renderer.draw(plan::TileMeshId::signed_distances);
}

}  // namespace nearfield::passes
