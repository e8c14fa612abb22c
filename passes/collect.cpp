#include <passes/collect.hpp>

#include <shaders/collect_colors_comp.hpp>
#include <shaders/collect_comp.hpp>

namespace nearfield::passes {

Collect::Collect(const gpu::Device& device, const ComputeLayout& layout)
    : numbers_(device, layout, shaders::collect_comp, "nearfield collect numbers"),
      colors_(device, layout, shaders::collect_colors_comp, "nearfield collect colours") {}

Collect::Output Collect::declare(TileGraph& graph, graph::Handle input, graph::Handle hits,
                                 Output output, IntersectionStrategy strategy) const {
    graph.add_pass(
        "collect", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(hits, graph::Access::sampled_in_compute);
            output.samples = pass.write(output.samples, graph::Access::storage_write_in_compute);
            if (output.kept_hits != graph::Handle{}) {
                output.kept_hits =
                    pass.write(output.kept_hits, graph::Access::storage_write_in_compute);
            }
        },
        [this, strategy](VkCommandBuffer commands, const RecordContext& context) {
            record(commands, context, strategy);
        });
    return output;
}

void Collect::record(VkCommandBuffer commands, const RecordContext& context,
                     IntersectionStrategy strategy) const {
    const ComputeShader& shader = strategy == IntersectionStrategy::blend ? colors_ : numbers_;
    shader.bind(commands, context.sets.samples[static_cast<std::size_t>(strategy)]);
    shader.dispatch_groups<plan::CollectPush>(commands, context.batch, plan::group_list(strategy),
                                              context.sample_capacity);
}

}  // namespace nearfield::passes
