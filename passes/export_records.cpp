#include <engine/gpu/pipeline.hpp>
#include <engine/graph/print.hpp>
#include <passes/export_records.hpp>

#include <shaders/export_records_comp.hpp>

namespace nearfield::passes {
namespace {

using graph::Access;

struct RecordsPush {
    std::uint32_t step, first_block, block_count, point_count, word, details, points, rings,
        ring_count, flags;
    float cell, near;
    std::uint32_t capacity;
};
static_assert(sizeof(RecordsPush) == ComputeLayout::push_bytes);

}  // namespace

ExportRecords::ExportRecords(const gpu::Device& device, const ComputeLayout& layout)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::export_records_comp,
                                           "nearfield export records")),
      words_(graph_.import_buffer({"point results"}, {Access::storage_write_in_compute, {}})),
      tables_(graph_.import_buffer({"tables", true, false})),
      blocks_(graph_.import_buffer({"record blocks"})),
      records_(
          graph_.import_buffer({"records"}, {Access::exported_buffer, Access::exported_buffer})) {
    graph::Handle blocks;
    graph::Handle records;
    // The first pass writes no record. It waits for a buffer of the host all the same: its shader
    // has the binding, and to validation layers that is an access.
    graph_.add_pass(
        "count records", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(words_, Access::storage_read_in_compute);
            pass.read(tables_, Access::storage_read_in_compute);
            blocks = pass.write(blocks_, Access::storage_write_in_compute);
            records = pass.write(records_, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { dispatch_runs(commands, Step::count); });
    graph_.add_pass(
        "place records", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            blocks = pass.write(blocks, Access::storage_write_in_compute);
            records = pass.write(records, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { dispatch_place(commands); });
    graph_.add_pass(
        "write records", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(words_, Access::storage_read_in_compute);
            pass.read(tables_, Access::storage_read_in_compute);
            pass.read(blocks, Access::storage_read_in_compute);
            static_cast<void>(pass.write(records, Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { dispatch_runs(commands, Step::write); });
    executor_ = graph::make_executor(device, graph_);
}

void ExportRecords::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                           const Item& item) {
    item_ = item;
    executor_->set_buffer(words_, item.words);
    executor_->set_buffer(blocks_, item.blocks);
    executor_->set_buffer(records_, item.output);
    executor_->execute(graph_, commands, timestamps);
}

void ExportRecords::dispatch_runs(VkCommandBuffer commands, Step step) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    for (std::size_t i = 0; i < item_.runs.size(); ++i) {
        const plan::PointRunOutput& run = item_.runs[i];
        functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                          &item_.sets[i], 0, nullptr);
        const RecordsPush push{static_cast<std::uint32_t>(step),
                               run.first_block,
                               run.blocks(),
                               run.count,
                               run.first,
                               item_.details[i],
                               run.table,
                               run.rings.first_word,
                               run.rings.count,
                               run.flags,
                               static_cast<float>(item_.records->cell),
                               item_.records->near,
                               item_.records->capacity};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     sizeof(push), &push);
        dispatch_threads(functions, commands, run.blocks());
    }
}

void ExportRecords::dispatch_place(VkCommandBuffer commands) const {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    functions.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1,
                                      &item_.sets.back(), 0, nullptr);
    RecordsPush push{};
    push.step = static_cast<std::uint32_t>(Step::place);
    push.block_count = item_.records->block_count;
    push.capacity = item_.records->capacity;
    functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push),
                                 &push);
    dispatch_threads(functions, commands, 1);
}

std::string ExportRecords::print(GraphFormat format) const {
    return graph::print(graph_, executor_->baked(), format);
}

}  // namespace nearfield::passes
