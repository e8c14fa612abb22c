#include <engine/gpu/pipeline.hpp>
#include <passes/blocks.hpp>

#include <shaders/resolve_blocks_comp.hpp>
#include <shaders/resolve_features_comp.hpp>
#include <shaders/resolve_field_points_by_lists_comp.hpp>

#include <utility>

namespace nearfield::passes {

Blocks::Blocks(const gpu::Device& device, const ComputeLayout& layout, const RecordContext& context)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      context_(&context),
      values_(gpu::make_compute_pipeline(device, layout_, shaders::resolve_blocks_comp,
                                         "nearfield resolve blocks")),
      features_(gpu::make_compute_pipeline(device, layout_, shaders::resolve_features_comp,
                                           "nearfield resolve features")),
      points_(gpu::make_compute_pipeline(device, layout_,
                                         shaders::resolve_field_points_by_lists_comp,
                                         "nearfield resolve field points by lists")) {}

void Blocks::bind(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline,
                  VkDescriptorSet set) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set,
                                      0, nullptr);
}

graph::Handle Blocks::declare(graph::Graph& graph, const char* name, graph::Handle input,
                              graph::Handle scratch, graph::Handle field,
                              graph::Record record) const {
    graph.add_pass(
        name, graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(scratch, graph::Access::storage_read_in_compute);
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        std::move(record));
    return field;
}

graph::Handle Blocks::declare_values(graph::Graph& graph, graph::Handle input,
                                     graph::Handle scratch, graph::Handle field) const {
    return declare(graph, "resolve blocks", input, scratch, field,
                   [this](VkCommandBuffer commands) { record_values(commands); });
}

graph::Handle Blocks::declare_features(graph::Graph& graph, graph::Handle input,
                                       graph::Handle scratch, graph::Handle field) const {
    return declare(graph, "resolve features", input, scratch, field,
                   [this](VkCommandBuffer commands) { record_features(commands); });
}

graph::Handle Blocks::declare_points(graph::Graph& graph, graph::Handle input,
                                     graph::Handle scratch, graph::Handle field) const {
    return declare(graph, "resolve field points by lists", input, scratch, field,
                   [this](VkCommandBuffer commands) { record_points(commands); });
}

void Blocks::record_values(VkCommandBuffer commands) const {
    constexpr std::uint32_t threads_per_block = plan::block_side / 2;
    const gpu::Functions& functions = device_->functions();
    const auto end =
        static_cast<std::uint32_t>(context_->round->compute.blocks.size()) * threads_per_block;
    bind(commands, values_, context_->blocks);
    dispatch_points(functions, commands, 0, end, [&](std::uint32_t first) {
        const std::uint32_t push[2] = {first, end};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), push);
    });
}

void Blocks::record_features(VkCommandBuffer commands) const {
    constexpr std::uint32_t cells = plan::block_side * plan::block_side;
    const gpu::Functions& functions = device_->functions();
    const plan::TileBatch& round = *context_->round;
    const auto end = static_cast<std::uint32_t>(round.compute.feature_blocks.size()) * cells;
    bind(commands, features_, context_->feature_blocks);
    dispatch_points(functions, commands, 0, end, [&](std::uint32_t first) {
        const std::uint32_t push[3] = {first, end, round.resident ? 1U : 0U};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), push);
    });
}

void Blocks::record_points(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    const plan::TileBatch& round = *context_->round;
    const auto points = static_cast<std::uint32_t>(round.lists.geometry().size());
    bind(commands, points_, context_->feature_blocks);
    for (const plan::FieldPointRun& run : round.field_point_runs) {
        dispatch_points(
            functions, commands, run.first, run.first + run.count, [&](std::uint32_t first) {
                const std::uint32_t push[7] = {first,
                                               run.first + run.count,
                                               points,
                                               run.first_word,
                                               run.first,
                                               run.parts.words_per_point,
                                               run.parts.cells_per_point};
                functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                             sizeof(push), push);
            });
    }
}

}  // namespace nearfield::passes
