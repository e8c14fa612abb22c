#include <engine/gpu/pipeline.hpp>
#include <passes/resolve_points.hpp>

#include <shaders/resolve_points_by_lists_comp.hpp>
#include <shaders/resolve_points_comp.hpp>

namespace nearfield::passes {

ResolvePoints::ResolvePoints(const gpu::Device& device, const ComputeLayout& layout,
                             const RecordContext& context, Source source)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      context_(&context),
      source_(source),
      pipeline_(source == Source::images
                    ? gpu::make_compute_pipeline(device, layout_, shaders::resolve_points_comp,
                                                 "nearfield resolve points")
                    : gpu::make_compute_pipeline(device, layout_,
                                                 shaders::resolve_points_by_lists_comp,
                                                 "nearfield resolve points by lists")) {}

void ResolvePoints::declare(graph::Graph& graph, graph::Handle input, graph::Handle results,
                            graph::Handle features, graph::Handle sign) const {
    const bool by_images = source_ == Source::images;
    graph.add_pass(
        by_images ? "resolve points" : "resolve points by lists", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            if (by_images) {
                pass.read(features, graph::Access::sampled_in_compute);
                pass.read(sign, graph::Access::sampled_in_compute);
            }
            static_cast<void>(pass.write(results, graph::Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { record(commands); });
}

void ResolvePoints::record(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    const VkDescriptorSet set =
        source_ == Source::images ? context_->points : context_->points_by_lists;
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set,
                                      0, nullptr);
    const auto count = static_cast<std::uint32_t>(context_->round->points.size());
    dispatch_points(functions, commands, 0, count, [&](std::uint32_t first) {
        const std::uint32_t push[3] = {first, count,
                                       context_->round->resident ? count : plan::not_asked};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), push);
    });
}

}  // namespace nearfield::passes
