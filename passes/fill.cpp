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
    const auto draw_all = [&](plan::DrawRange plan::TileDraw::*range, std::uint32_t value) {
        for (const plan::TileDraw& tile : context_->round->distance_draws) {
            if (tile.sign == SignEncoding::stencil) {
                renderer.draw(tile, tile.*range, 1.0F, value);
            }
        }
    };
    renderer.bind(pipelines_->clear.get());
    renderer.stencil(all, all, 0);
    draw_all(&plan::TileDraw::rectangle, 0);
    renderer.bind(pipelines_->parity.get());
    renderer.stencil(all, parity_b, 0);
    draw_all(&plan::TileDraw::b, 0);
    renderer.bind(pipelines_->mark.get());
    renderer.stencil(parity_b, 0, parity_b);
    draw_all(&plan::TileDraw::rectangle, filled_mask);
}

}  // namespace nearfield::passes
