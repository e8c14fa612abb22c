#include <passes/export_samples.hpp>

#include <shaders/export_samples_comp.hpp>

#include <functional>

namespace nearfield::passes {

using graph::Access;

// The graphs of the tile batches leave their hits readable (render::CompiledGraph), wherever they
// are stored.
ExportSamples::ExportSamples(const gpu::Device& device, const ComputeLayout& layout)
    : shader_(device, layout, shaders::export_samples_comp, "nearfield export samples"),
      summaries_(graph_.import_buffer({"tile summaries"}, {Access::storage_write_in_compute, {}})),
      hits_(graph_.import_buffer({"found in cells"}, {Access::storage_read_in_compute, {}})),
      tables_(graph_.import_buffer({"tables", true, false})),
      blocks_(graph_.import_buffer({"sample blocks"})),
      samples_(graph_.import_buffer({"resident samples"},
                                    {Access::exported_buffer, Access::exported_buffer})) {
    graph::Handle blocks;
    graph::Handle samples;
    // The first pass writes no sample; see ExportRecords.
    graph_.add_pass(
        "count samples", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(summaries_, Access::storage_read_in_compute);
            pass.read(hits_, Access::storage_read_in_compute);
            pass.read(tables_, Access::storage_read_in_compute);
            blocks = pass.write(blocks_, Access::storage_write_in_compute);
            samples = pass.write(samples_, Access::storage_write_in_compute);
        },
        std::bind_front(&ExportSamples::dispatch_count, this));
    graph_.add_pass(
        "place samples", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            blocks = pass.write(blocks, Access::storage_write_in_compute);
            samples = pass.write(samples, Access::storage_write_in_compute);
        },
        std::bind_front(&ExportSamples::dispatch_place, this));
    graph_.add_pass(
        "write samples", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(hits_, Access::storage_read_in_compute);
            pass.read(tables_, Access::storage_read_in_compute);
            pass.read(blocks, Access::storage_read_in_compute);
            static_cast<void>(pass.write(samples, Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands, const Item& item) {
            dispatch_rows(commands, item, plan::write_step);
        });
    graph_.compile(device);
}

void ExportSamples::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                           const Item& item) const {
    graph::Executor& executor = graph_.executor();
    executor.set_buffer(summaries_, item.summaries);
    executor.set_buffer(blocks_, item.blocks);
    executor.set_buffer(samples_, item.output);
    graph_.execute(commands, timestamps, item);
}

void ExportSamples::dispatch_count(VkCommandBuffer commands, const Item& item) const {
    shader_.bind(commands);
    std::uint32_t first_tile = 0;
    for (std::size_t i = 0; i < item.runs.size(); ++i) {
        const plan::SampleRunOutput& run = item.runs[i];
        shader_.bind_set(commands, item.sets[2 * i]);
        dispatch(commands, item, plan::box_step, run.table, first_tile, run.tile_count,
                 run.tile_count);
        first_tile += run.tile_count;
    }
    dispatch_rows(commands, item, plan::count_step);
}

void ExportSamples::dispatch_place(VkCommandBuffer commands, const Item& item) const {
    shader_.bind(commands, item.sets.back());
    dispatch(commands, item, plan::place_step, 0, 0, item.samples->tile_count, 1);
}

/// One thread per row of each tile; nothing if the samples are omitted.
void ExportSamples::dispatch_rows(VkCommandBuffer commands, const Item& item,
                                  std::uint32_t step) const {
    if (item.samples->block_count == 0) {
        return;
    }
    shader_.bind(commands);
    for (std::size_t i = 0; i < item.runs.size(); ++i) {
        const plan::SampleRunOutput& run = item.runs[i];
        shader_.bind_set(commands, item.sets[2 * i + 1]);
        for (std::uint32_t tile = 0; tile < run.tile_count; ++tile) {
            dispatch(commands, item, step, run.table + tile * plan::words_of_tile, 0,
                     item.samples->tile_count, item.tiles[run.first_tile + tile].height);
        }
    }
}

void ExportSamples::dispatch(VkCommandBuffer commands, const Item& item, std::uint32_t step,
                             std::uint32_t table, std::uint32_t first_tile,
                             std::uint32_t tile_count, std::uint32_t threads) const {
    const plan::SamplesOutput& samples = *item.samples;
    shader_.push(commands, plan::ExportSamplesPush{
                               step, table, first_tile, tile_count, samples.block_count,
                               samples.capacity, samples.rings.first_word, samples.rings.count,
                               samples.vertices, static_cast<float>(samples.cell)});
    shader_.dispatch_threads(commands, threads);
}

}  // namespace nearfield::passes
