#include <engine/gpu/pipeline.hpp>
#include <passes/collect.hpp>

#include <shaders/collect_comp.hpp>

namespace nearfield::passes {

Collect::Collect(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      frame_(&frame),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::collect_comp,
                                           "nearfield collect")) {}

void Collect::declare(graph::Graph& graph, graph::Handle input, graph::Handle hits,
                      graph::Handle samples) const {
    graph.add_pass(
        "collect", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(hits, graph::Access::sampled_in_compute);
            static_cast<void>(pass.write(samples, graph::Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { record(commands); });
}

void Collect::record(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                      &frame_->samples, 0, nullptr);
    for (const plan::TileDraw& tile : frame_->round->overlap_draws) {
        const std::uint32_t push[2] = {tile.tile, frame_->sample_capacity};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), push);
        dispatch_tile(functions, commands, tile);
    }
}

}  // namespace nearfield::passes
