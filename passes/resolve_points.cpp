#include <engine/gpu/pipeline.hpp>
#include <passes/resolve_points.hpp>

#include <shaders/resolve_points_by_lists_comp.hpp>
#include <shaders/resolve_points_comp.hpp>

namespace nearfield::passes {

ResolvePoints::ResolvePoints(const gpu::Device& device, const ComputeLayout& layout,
                             const Frame& frame)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      frame_(&frame),
      by_images_(gpu::make_compute_pipeline(device, layout_, shaders::resolve_points_comp,
                                            "nearfield resolve points")),
      by_lists_(gpu::make_compute_pipeline(device, layout_, shaders::resolve_points_by_lists_comp,
                                           "nearfield resolve points by lists")) {}

void ResolvePoints::declare(graph::Graph& graph, graph::Handle input, graph::Handle features,
                            graph::Handle sign, graph::Handle results) const {
    graph.add_pass(
        "resolve points", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(features, graph::Access::sampled_in_compute);
            pass.read(sign, graph::Access::sampled_in_compute);
            static_cast<void>(pass.write(results, graph::Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { record(commands, by_images_, frame_->points); });
}

void ResolvePoints::declare_by_lists(graph::Graph& graph, graph::Handle input,
                                     graph::Handle results) const {
    graph.add_pass(
        "resolve points by lists", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            static_cast<void>(pass.write(results, graph::Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { record(commands, by_lists_, frame_->points_by_lists); });
}

void ResolvePoints::record(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline,
                           VkDescriptorSet set) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set,
                                      0, nullptr);
    const auto count = static_cast<std::uint32_t>(frame_->round->points.size());
    dispatch_points(functions, commands, 0, count, [&](std::uint32_t first) {
        const std::uint32_t push[3] = {first, count,
                                       frame_->round->resident ? count : plan::not_asked};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), push);
    });
}

}  // namespace nearfield::passes
