#include <passes/drawing.hpp>
#include <passes/intersect.hpp>
#include <passes/tile_renderer.hpp>

#include <string>
#include <vector>

namespace nearfield::passes {

using plan::OverlapStep;
using plan::Part;

graph::Handle Intersect::declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent,
                                 IntersectionStrategy strategy) const {
    const StrategySteps& steps = strategies_->steps(strategy);
    const std::string name = to_string(strategy);
    return add_drawing(graph, steps.pass_name,
                       {{graph::unbound, mesh, graph::Access::vertex_buffer}},
                       {name + " hits", steps.color_format, extent},
                       {name + " depth and stencil", device_->stencil_format(), extent},
                       [this, strategy](VkCommandBuffer commands, const RecordContext& context) {
                           record(commands, context, strategy);
                       });
}

void Intersect::record(VkCommandBuffer commands, const RecordContext& context,
                       IntersectionStrategy strategy) const {
    using namespace stencil_bits;
    const StrategySteps& steps = strategies_->steps(strategy);
    const TileRenderer renderer(*device_, layout_, commands, context);
    const auto range = [&](OverlapStep step) {
        return context.batch.raster.meshes.range(plan::overlaps_of(strategy, step));
    };

    renderer.bind(steps.clear);
    renderer.stencil(all, all, 0);
    renderer.draw(range(OverlapStep::clear), 1.0F, 0);

    // Where the stencil has counted to `count`: in volumes their fill has to be set as well.
    const auto fill = [&](OverlapStep step, std::uint32_t parity) {
        renderer.bind(steps.parity);
        renderer.stencil(all, parity, 0);
        renderer.draw(range(step), 1.0F, 0);
    };
    const auto take = [&](Part part, std::uint32_t parity, std::uint32_t count) {
        const std::uint32_t filled = part == Part::volume ? parity : 0;
        renderer.stencil(filled | counter, counter, filled | count);
    };
    fill(OverlapStep::parity_b, parity_b);
    renderer.bind(steps.b);
    take(Part::volume, parity_b, 0);
    renderer.draw(range(OverlapStep::volume_b), steps.depth_b, steps.value_b);
    take(Part::boundary, parity_b, 0);
    renderer.draw(range(OverlapStep::boundary_b), steps.depth_b, steps.value_b);

    fill(OverlapStep::parity_a, parity_a);
    renderer.bind(steps.a);
    take(Part::volume, parity_a, steps.count_b);
    renderer.draw(range(OverlapStep::volume_a), steps.depth_a, steps.value_a);
    take(Part::boundary, parity_a, steps.count_b);
    renderer.draw(range(OverlapStep::boundary_a), steps.depth_a, steps.value_a);

    const std::vector<plan::WatchedTile>& watched = context.batch.raster.watched;
    const std::uint32_t first = range(OverlapStep::watched_a).first;
    for (std::uint32_t query = 0; query < watched.size(); ++query) {
        if (watched[query].strategy == strategy) {
            take(watched[query].part_a, parity_a, steps.count_b);
            early_out_->begin(commands, query);
            renderer.draw({first + watched[query].a.first, watched[query].a.count}, steps.depth_a,
                          steps.value_a);
            early_out_->end(commands, query);
        }
    }
}

}  // namespace nearfield::passes
