#include <passes/collect.hpp>

#include <shaders/collect_colors_comp.hpp>
#include <shaders/collect_comp.hpp>

namespace nearfield::passes {

using graph::Access;

Collect::Collect(const gpu::Device& device, const graph::ComputeLayout& layout)
    : numbers_(device, layout, shaders::collect_comp, "nearfield collect numbers"),
      colors_(device, layout, shaders::collect_colors_comp, "nearfield collect colours") {}

void Collect::declare(TileGraph& graph, graph::Handle input, graph::Handle hits,
                      graph::Handle& samples, IntersectionStrategy strategy) const {
    add_pass(graph, "collect", strategy == IntersectionStrategy::blend ? colors_ : numbers_,
             {{0, input, read, input_parts::tiles},
              {4, hits, Access::sampled_in_compute},
              {2, samples, write, sample_parts::summaries},
              {3, samples, write, sample_parts::samples}},
             [strategy](const ComputeShader& shader, VkCommandBuffer commands,
                        const RecordContext& context) {
                 shader.dispatch_groups<plan::CollectPush>(
                     commands, context.batch, plan::group_list(strategy), context.sample_capacity);
             });
}

}  // namespace nearfield::passes
