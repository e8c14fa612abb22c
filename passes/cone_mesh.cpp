#include <engine/gpu/pipeline.hpp>
#include <passes/cone_mesh.hpp>
#include <passes/stencil_pipelines.hpp>
#include <passes/tile_renderer.hpp>

#include <shaders/mesh_vert.hpp>
#include <shaders/number_frag.hpp>
#include <shaders/number_in_tile_frag.hpp>
#include <shaders/tile_mesh_vert.hpp>

namespace nearfield::passes {

ConeMesh::ConeMesh(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass,
                   const RecordContext& context)
    : device_(&device), layout_(layout), context_(&context) {
    gpu::GraphicsPipelineDescription description;
    description.render_pass = render_pass;
    description.layout = layout;
    description.vertex_shader = shaders::mesh_vert;
    description.fragment_shader = shaders::number_frag;
    description.depth_test = true;

    description.name = "nearfield distance clear";
    description.depth_compare = VK_COMPARE_OP_ALWAYS;
    clear_ = gpu::make_graphics_pipeline(device, description);

    description.name = "nearfield distance mesh";
    description.vertex_shader = shaders::tile_mesh_vert;
    description.fragment_shader = shaders::number_in_tile_frag;
    description.depth_compare = VK_COMPARE_OP_LESS;
    draw_ = gpu::make_graphics_pipeline(device, description);
}

graph::Handle ConeMesh::declare(graph::Graph& graph, graph::Handle mesh, VkExtent2D extent) const {
    graph::Handle features = graph.create_image({"features", number_format, extent});
    const graph::Handle depth = graph.create_image({"distance", distance_depth_format, extent});
    graph.add_pass(
        "cone mesh", graph::PassKind::graphics,
        [&](graph::PassBuilder& pass) {
            pass.read(mesh, graph::Access::vertex_buffer);
            features = pass.write(features, graph::Access::color_attachment);
            static_cast<void>(pass.write(depth, graph::Access::depth_stencil_attachment));
        },
        [this](VkCommandBuffer commands) { record(commands); });
    return features;
}

void ConeMesh::record(VkCommandBuffer commands) const {
    const TileRenderer renderer(*device_, layout_, commands, *context_);
    renderer.stencil(0, 0, 0);
    renderer.bind(clear_.get());
    renderer.draw(context_->round->meshes.range(plan::rectangles_of(SignEncoding::stencil),
                                                plan::rectangles_of(SignEncoding::color)),
                  1.0F, plan::no_feature);
    renderer.bind(draw_.get());
    renderer.draw(plan::TileMeshId::distances);
}

}  // namespace nearfield::passes
