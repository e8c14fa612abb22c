#include <engine/gpu/pipeline.hpp>
#include <passes/collect.hpp>

#include <shaders/collect_colors_comp.hpp>
#include <shaders/collect_comp.hpp>

namespace nearfield::passes {

// A workgroup has 16 x 4 threads, each with a strip of 8 cells.
static_assert(plan::overlap_group_width == 16 && plan::overlap_group_height == 4 * 8);

Collect::Collect(const gpu::Device& device, const ComputeLayout& layout,
                 const RecordContext& context)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      context_(&context),
      numbers_(gpu::make_compute_pipeline(device, layout_, shaders::collect_comp,
                                          "nearfield collect numbers")),
      colors_(gpu::make_compute_pipeline(device, layout_, shaders::collect_colors_comp,
                                         "nearfield collect colours")) {}

Collect::Output Collect::declare(graph::Graph& graph, graph::Handle input, graph::Handle hits,
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
        [this, strategy](VkCommandBuffer commands) { record(commands, strategy); });
    return output;
}

void Collect::record(VkCommandBuffer commands, IntersectionStrategy strategy) const {
    const gpu::Functions& functions = device_->functions();
    const auto index = static_cast<std::size_t>(strategy);
    const bool colors = strategy == IntersectionStrategy::blend;
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                colors ? colors_.get() : numbers_.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                      &context_->samples[index], 0, nullptr);
    dispatch_groups(functions, commands, *context_->round, plan::group_list(strategy),
                    [&](std::uint32_t first) {
                        const std::uint32_t push[2] = {first, context_->sample_capacity};
                        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT,
                                                     0, sizeof(push), push);
                    });
}

}  // namespace nearfield::passes
