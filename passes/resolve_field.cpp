#include <engine/gpu/pipeline.hpp>
#include <passes/resolve_field.hpp>

#include <shaders/resolve_field_comp.hpp>

namespace nearfield::passes {

ResolveField::ResolveField(const gpu::Device& device, const ComputeLayout& layout,
                           const Frame& frame)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      frame_(&frame),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::resolve_field_comp,
                                           "nearfield resolve field")) {}

void ResolveField::declare(graph::Graph& graph, graph::Handle input, graph::Handle features,
                           graph::Handle sign, graph::Handle values) const {
    graph.add_pass(
        "resolve field", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(features, graph::Access::sampled_in_compute);
            pass.read(sign, graph::Access::sampled_in_compute);
            static_cast<void>(pass.write(values, graph::Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { record(commands); });
}

void ResolveField::record(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                      &frame_->field, 0, nullptr);
    for (const plan::TileDraw& tile : frame_->round->distance_draws) {
        if (tile.field) {
            const std::uint32_t push[2] = {tile.tile, tile.first_value};
            functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                         sizeof(push), push);
            dispatch_tile(functions, commands, tile);
        }
    }
}

}  // namespace nearfield::passes
