#include <passes/drawing.hpp>
#include <passes/fill.hpp>
#include <passes/tile_renderer.hpp>

#include <functional>

namespace nearfield::passes {

graph::Handle Fill::declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent) const {
    return add_drawing(graph, "fill", {{graph::unbound, mesh, graph::Access::vertex_buffer}},
                       {"sign", number_format, extent},
                       {"fill stencil", device_->stencil_format(), extent},
                       std::bind_front(&Fill::record, this));
}

void Fill::record(VkCommandBuffer commands, const RecordContext& context) const {
    using namespace stencil_bits;
    const TileRenderer renderer(*device_, layout_, commands, context);
    const plan::TileMeshes& meshes = context.batch.raster.meshes;
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
