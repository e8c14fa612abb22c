#include <passes/export_records.hpp>

#include <shaders/export_records_comp.hpp>

#include <functional>

namespace nearfield::passes {

using graph::Access;

ExportRecords::ExportRecords(const gpu::Device& device, const ComputeLayout& layout)
    : shader_(device, layout, shaders::export_records_comp, "nearfield export records"),
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
        [this](VkCommandBuffer commands, const Item& item) {
            dispatch_runs(commands, item, plan::count_step);
        });
    graph_.add_pass(
        "place records", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            blocks = pass.write(blocks, Access::storage_write_in_compute);
            records = pass.write(records, Access::storage_write_in_compute);
        },
        std::bind_front(&ExportRecords::dispatch_place, this));
    graph_.add_pass(
        "write records", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(words_, Access::storage_read_in_compute);
            pass.read(tables_, Access::storage_read_in_compute);
            pass.read(blocks, Access::storage_read_in_compute);
            static_cast<void>(pass.write(records, Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands, const Item& item) {
            dispatch_runs(commands, item, plan::write_step);
        });
    graph_.compile(device);
}

void ExportRecords::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                           const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(words_, item.words);
    executor.set_buffer(blocks_, item.blocks);
    executor.set_buffer(records_, item.output);
    graph_.execute(commands, timestamps, item);
}

void ExportRecords::dispatch_runs(VkCommandBuffer commands, const Item& item,
                                  std::uint32_t step) const {
    shader_.bind(commands);
    for (std::size_t i = 0; i < item.runs.size(); ++i) {
        const plan::PointRunOutput& run = item.runs[i];
        shader_.bind_set(commands, item.sets[i]);
        const plan::ExportRecordsPush push{step,
                                           run.first_block,
                                           run.blocks(),
                                           run.count,
                                           run.first,
                                           item.details[i],
                                           run.table,
                                           run.rings.first_word,
                                           run.rings.count,
                                           run.flags,
                                           static_cast<float>(item.records->cell),
                                           item.records->near,
                                           item.records->capacity};
        shader_.push(commands, push);
        shader_.dispatch_threads(commands, run.blocks());
    }
}

void ExportRecords::dispatch_place(VkCommandBuffer commands, const Item& item) const {
    shader_.bind(commands, item.sets.back());
    plan::ExportRecordsPush push{};
    push.step = plan::place_step;
    push.block_count = item.records->block_count;
    push.capacity = item.records->capacity;
    shader_.push(commands, push);
    shader_.dispatch_threads(commands, 1);
}

}  // namespace nearfield::passes
