#include <engine/gpu/pipeline.hpp>
#include <passes/collect_gradients.hpp>

#include <shaders/collect_gradients_comp.hpp>

namespace nearfield::passes {

CollectGradients::CollectGradients(const gpu::Device& device, const ComputeLayout& layout,
                                   const RecordContext& context)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      context_(&context),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::collect_gradients_comp,
                                           "nearfield collect gradients")) {}

graph::Handle CollectGradients::declare(graph::Graph& graph, graph::Handle input,
                                        graph::Handle gradients, graph::Handle field) const {
    graph.add_pass(
        "collect gradients", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(gradients, graph::Access::sampled_in_compute);
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { record(commands); });
    return field;
}

void CollectGradients::record(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                      &context_->gradients, 0, nullptr);
    const auto dispatch = [&](std::uint32_t begin, std::uint32_t end, std::uint32_t first_word,
                              std::uint32_t origin, std::uint32_t words_per_point,
                              std::uint32_t tile) {
        dispatch_points(functions, commands, begin, end, [&](std::uint32_t first) {
            const std::uint32_t push[6] = {first, end, first_word, origin, words_per_point, tile};
            functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                         sizeof(push), push);
        });
    };
    for (const plan::TileDraw& tile : context_->round->distance_draws) {
        if (tile.first_gradient != plan::not_asked) {
            dispatch(0, tile.width * tile.height, tile.first_gradient, 0, 0, tile.tile);
        }
    }
    for (const plan::FieldPointRun& run : context_->round->field_point_runs) {
        if (run.parts.blended) {
            dispatch(4 * run.first, 4 * (run.first + run.count), run.first_word, run.first,
                     run.parts.words_per_point, 0);
        }
    }
}

}  // namespace nearfield::passes
