#include <passes/cone_mesh.hpp>
#include <passes/drawing.hpp>
#include <passes/stencil_pipelines.hpp>
#include <passes/tile_renderer.hpp>

#include <shaders/mesh_vert.hpp>
#include <shaders/number_frag.hpp>
#include <shaders/number_in_tile_frag.hpp>
#include <shaders/tile_mesh_vert.hpp>

#include <functional>

namespace nearfield::passes {

ConeMesh::ConeMesh(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass)
    : device_(&device), layout_(layout) {
    gpu::GraphicsPipelineDescription description =
        describe_drawing(layout, render_pass, shaders::mesh_vert, shaders::number_frag);
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

graph::Handle ConeMesh::declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent) const {
    return add_drawing(graph, "cone mesh", {{graph::unbound, mesh, graph::Access::vertex_buffer}},
                       {"features", number_format, extent},
                       {"distance", distance_depth_format, extent},
                       std::bind_front(&ConeMesh::record, this));
}

void ConeMesh::record(VkCommandBuffer commands, const RecordContext& context) const {
    const TileRenderer renderer(*device_, layout_, commands, context);
    renderer.stencil(0, 0, 0);
    renderer.bind(clear_.get());
    renderer.draw(context.batch.raster.meshes.range(plan::rectangles_of(SignEncoding::stencil),
                                                    plan::rectangles_of(SignEncoding::color)),
                  1.0F, plan::no_feature);
    renderer.bind(draw_.get());
    renderer.draw(plan::TileMeshId::distances);
}

}  // namespace nearfield::passes
