#include <passes/intersect.hpp>
#include <passes/tile_renderer.hpp>

namespace nearfield::passes {

using plan::Part;
using plan::TileDraw;

graph::Handle Intersect::declare(graph::Graph& graph, graph::Handle mesh, VkExtent2D extent) const {
    graph::Handle hits = graph.create_image({"hits", number_format, extent});
    const graph::Handle stencil =
        graph.create_image({"intersection stencil", device_->stencil_format(), extent});
    graph.add_pass(
        "intersect", graph::PassKind::graphics,
        [&](graph::PassBuilder& pass) {
            pass.read(mesh, graph::Access::vertex_buffer);
            hits = pass.write(hits, graph::Access::color_attachment);
            static_cast<void>(pass.write(stencil, graph::Access::depth_stencil_attachment));
        },
        [this](VkCommandBuffer commands) { record(commands); });
    return hits;
}

void Intersect::record(VkCommandBuffer commands) const {
    using namespace stencil_bits;
    const TileRenderer renderer(*device_, layout_, commands, *frame_);
    // Draws one step into every tile it applies to.
    const auto step = [&](const gpu::Owned<VkPipeline>& pipeline, std::uint32_t compare_mask,
                          std::uint32_t write_mask, std::uint32_t reference, auto&& applies,
                          plan::DrawRange TileDraw::*range, std::uint32_t value) {
        renderer.bind(pipeline.get());
        renderer.stencil(compare_mask, write_mask, reference);
        for (const TileDraw& tile : frame_->round->overlap_draws) {
            if (applies(tile)) {
                renderer.draw(tile, tile.*range, 1.0F, value);
            }
        }
    };
    const auto always = [](const TileDraw&) { return true; };
    const auto volume_a = [](const TileDraw& tile) { return tile.part_a == Part::volume; };
    const auto volume_b = [](const TileDraw& tile) { return tile.part_b == Part::volume; };
    const auto boundary_a = [](const TileDraw& tile) { return tile.part_a == Part::boundary; };
    const auto boundary_b = [](const TileDraw& tile) { return tile.part_b == Part::boundary; };
    const StencilPipelines& p = *pipelines_;

    step(p.clear, all, all, 0, always, &TileDraw::rectangle, plan::no_feature);
    // B: 0 becomes 1.
    step(p.parity, all, parity_b, 0, volume_b, &TileDraw::b, 0);
    step(p.count, parity_b, counter, parity_b, volume_b, &TileDraw::rectangle, 0);
    step(p.set, all, counter, 1, boundary_b, &TileDraw::b, 0);
    // A: 1 becomes 2. A boundary says at once which of its edges made it 2.
    step(p.hit, counter, counter, 1, boundary_a, &TileDraw::a, 0);
    step(p.parity, all, parity_a, 0, volume_a, &TileDraw::a, 0);
    step(p.count, parity_a | counter, counter, parity_a | 1U, volume_a, &TileDraw::rectangle, 0);
    step(p.mark, counter, 0, 2, volume_a, &TileDraw::rectangle, 0);
}

}  // namespace nearfield::passes
