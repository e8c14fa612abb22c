#include <passes/intersect.hpp>
#include <passes/tile_renderer.hpp>

#include <string>

namespace nearfield::passes {

using plan::Part;
using plan::TileDraw;

graph::Handle Intersect::declare(graph::Graph& graph, graph::Handle mesh, VkExtent2D extent,
                                 IntersectionStrategy strategy) const {
    const StrategySteps& steps = strategies_->steps(strategy);
    const std::string name = to_string(strategy);
    graph::Handle hits = graph.create_image({name + " hits", steps.color_format, extent});
    const graph::Handle depth_stencil =
        graph.create_image({name + " depth and stencil", device_->stencil_format(), extent});
    graph.add_pass(
        steps.pass_name, graph::PassKind::graphics,
        [&](graph::PassBuilder& pass) {
            pass.read(mesh, graph::Access::vertex_buffer);
            hits = pass.write(hits, graph::Access::color_attachment);
            static_cast<void>(pass.write(depth_stencil, graph::Access::depth_stencil_attachment));
        },
        [this, strategy](VkCommandBuffer commands) { record(commands, strategy); });
    return hits;
}

void Intersect::record(VkCommandBuffer commands, IntersectionStrategy strategy) const {
    using namespace stencil_bits;
    const StrategySteps& steps = strategies_->steps(strategy);
    const TileRenderer renderer(*device_, layout_, commands, *context_);
    const auto& tiles = context_->round->overlap_draws[static_cast<std::size_t>(strategy)];

    renderer.bind(steps.clear);
    renderer.stencil(all, all, 0);
    for (const TileDraw& tile : tiles) {
        renderer.draw(tile, tile.rectangle, 1.0F, 0);
    }
    // Draws one of the shapes into every tile, where the stencil has counted to `count`.
    const auto draw = [&](VkPipeline pipeline, Part TileDraw::*part,
                          plan::DrawRange TileDraw::*mesh, std::uint32_t parity,
                          std::uint32_t count, auto&& draw_one) {
        renderer.bind(steps.parity);
        renderer.stencil(all, parity, 0);
        for (const TileDraw& tile : tiles) {
            if (tile.*part == Part::volume) {
                renderer.draw(tile, tile.*mesh, 1.0F, 0);
            }
        }
        renderer.bind(pipeline);
        renderer.stencil(parity | counter, counter, parity | count);
        for (const TileDraw& tile : tiles) {
            if (tile.*part == Part::volume) {
                draw_one(tile, tile.rectangle);
            }
        }
        renderer.stencil(counter, counter, count);
        for (const TileDraw& tile : tiles) {
            if (tile.*part == Part::boundary) {
                draw_one(tile, tile.*mesh);
            }
        }
    };
    draw(steps.b, &TileDraw::part_b, &TileDraw::b, parity_b, 0,
         [&](const TileDraw& tile, plan::DrawRange range) {
             renderer.draw(tile, range, steps.depth_b, steps.value_b);
         });
    draw(steps.a, &TileDraw::part_a, &TileDraw::a, parity_a, steps.count_b,
         [&](const TileDraw& tile, plan::DrawRange range) {
             early_out_->begin(commands, tile);
             renderer.draw(tile, range, steps.depth_a, steps.value_a);
             early_out_->end(commands, tile);
         });
}

}  // namespace nearfield::passes
