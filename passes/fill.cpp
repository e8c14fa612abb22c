#include <passes/fill.hpp>
#include <passes/tile_renderer.hpp>

namespace nearfield::passes {

graph::Handle Fill::declare(graph::Graph& graph, graph::Handle mesh, VkExtent2D extent) const {
    graph::Handle sign = graph.create_image({"sign", number_format, extent});
    const graph::Handle stencil =
        graph.create_image({"fill stencil", device_->stencil_format(), extent});
    graph.add_pass(
        "fill", graph::PassKind::graphics,
        [&](graph::PassBuilder& pass) {
            pass.read(mesh, graph::Access::vertex_buffer);
            sign = pass.write(sign, graph::Access::color_attachment);
            static_cast<void>(pass.write(stencil, graph::Access::depth_stencil_attachment));
        },
        [this](VkCommandBuffer commands) { record(commands); });
    return sign;
}

void Fill::record(VkCommandBuffer commands) const {
    using namespace stencil_bits;
    const TileRenderer renderer(*device_, layout_, commands, *context_);
    const plan::TileMeshes& meshes = context_->round->meshes;
    const plan::DrawRange rectangles = meshes.range(plan::rectangles_of(SignEncoding::stencil));
    renderer.bind(pipelines_->clear.get());
    renderer.stencil(all, all, 0);
    renderer.draw(rectangles, 1.0F, 0);
    renderer.bind(pipelines_->parity.get());
    renderer.stencil(all, parity_b, 0);
    renderer.draw(meshes.range(plan::fills_of(SignEncoding::stencil)), 1.0F, 0);
    renderer.bind(pipelines_->mark.get());
    renderer.stencil(parity_b, 0, parity_b);
    renderer.draw(rectangles, 1.0F, filled_mask);
}

}  // namespace nearfield::passes
