#include <engine/gpu/pipeline.hpp>
#include <passes/blocks.hpp>

#include <shaders/list_blocks_comp.hpp>
#include <shaders/resolve_blocks_comp.hpp>
#include <shaders/resolve_field_points_by_lists_comp.hpp>

namespace nearfield::passes {

Blocks::Blocks(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      frame_(&frame),
      lists_(gpu::make_compute_pipeline(device, layout_, shaders::list_blocks_comp,
                                        "nearfield list blocks")),
      cells_(gpu::make_compute_pipeline(device, layout_, shaders::resolve_blocks_comp,
                                        "nearfield resolve blocks")),
      points_(gpu::make_compute_pipeline(device, layout_,
                                         shaders::resolve_field_points_by_lists_comp,
                                         "nearfield resolve field points by lists")) {}

void Blocks::bind(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                      &frame_->blocks, 0, nullptr);
}

graph::Handle Blocks::declare_lists(graph::Graph& graph, graph::Handle input,
                                    graph::Handle scratch) const {
    graph.add_pass(
        "list blocks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            scratch = pass.write(scratch, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { record_blocks(commands, lists_, 1); });
    return scratch;
}

graph::Handle Blocks::declare_cells(graph::Graph& graph, graph::Handle input, graph::Handle scratch,
                                    graph::Handle field) const {
    graph.add_pass(
        "resolve blocks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(scratch, graph::Access::storage_read_in_compute);
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { record_blocks(commands, cells_, plan::block_side); });
    return field;
}

void Blocks::record_blocks(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline,
                           std::uint32_t threads_per_block) const {
    const gpu::Functions& functions = device_->functions();
    const plan::Round& round = *frame_->round;
    const plan::ComputeWork& work = round.compute;
    const auto end = static_cast<std::uint32_t>(work.blocks.size()) * threads_per_block;
    bind(commands, pipeline);
    dispatch_points(functions, commands, 0, end, [&](std::uint32_t first) {
        const std::uint32_t push[5] = {
            first, end, static_cast<std::uint32_t>(round.lists.geometry().size()),
            static_cast<std::uint32_t>(work.mask_words + work.run_words), round.resident ? 1U : 0U};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), push);
    });
}

graph::Handle Blocks::declare_points(graph::Graph& graph, graph::Handle input,
                                     graph::Handle scratch, graph::Handle field) const {
    graph.add_pass(
        "resolve field points by lists", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            pass.read(scratch, graph::Access::storage_read_in_compute);
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { record_points(commands); });
    return field;
}

void Blocks::record_points(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    const plan::Round& round = *frame_->round;
    const auto points =
        static_cast<std::uint32_t>(round.lists.geometry().size() + round.compute.blocks.size());
    bind(commands, points_);
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
