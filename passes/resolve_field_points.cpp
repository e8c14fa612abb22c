#include <engine/gpu/pipeline.hpp>
#include <passes/resolve_field_points.hpp>

#include <shaders/resolve_field_points_comp.hpp>

namespace nearfield::passes {

ResolveFieldPoints::ResolveFieldPoints(const gpu::Device& device, const ComputeLayout& layout,
                                       const RecordContext& context)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      context_(&context),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::resolve_field_points_comp,
                                           "nearfield resolve field points")) {}

graph::Handle ResolveFieldPoints::declare(graph::Graph& graph, graph::Handle input,
                                          const FieldImages& images, graph::Handle field) const {
    graph.add_pass(
        "resolve field points", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            images.declare_reads(pass);
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { record(commands); });
    return field;
}

void ResolveFieldPoints::record(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    for (const plan::FieldPointRun& run : context_->round->field_point_runs) {
        bind_field_set(functions, commands, layout_, *context_, run.sign);
        dispatch_points(
            functions, commands, run.first, run.first + run.count, [&](std::uint32_t first) {
                const std::uint32_t push[7] = {
                    first,     run.first + run.count,     sign_mask(run.sign),      run.first_word,
                    run.first, run.parts.words_per_point, run.parts.cells_per_point};
                functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                             sizeof(push), push);
            });
    }
}

}  // namespace nearfield::passes
