#include <engine/gpu/pipeline.hpp>
#include <engine/graph/print.hpp>
#include <passes/export_samples.hpp>

#include <shaders/export_samples_comp.hpp>

namespace nearfield::passes {
namespace {

using graph::Access;

struct SamplesPush {
    std::uint32_t step, table, first_tile, tile_count, block_count, capacity, rings, ring_count,
        vertices;
    float cell;
};
static_assert(sizeof(SamplesPush) <= ComputeLayout::push_bytes);

}  // namespace

// The graphs of the tile batches leave their hits readable (render::CompiledGraph), wherever they
// are stored.
ExportSamples::ExportSamples(const gpu::Device& device, const ComputeLayout& layout)
    : device_(&device),
      layout_(layout.pipeline_layout()),
      pipeline_(gpu::make_compute_pipeline(device, layout_, shaders::export_samples_comp,
                                           "nearfield export samples")),
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
        [this](VkCommandBuffer commands) { dispatch_count(commands); });
    graph_.add_pass(
        "place samples", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            blocks = pass.write(blocks, Access::storage_write_in_compute);
            samples = pass.write(samples, Access::storage_write_in_compute);
        },
        [this](VkCommandBuffer commands) { dispatch_place(commands); });
    graph_.add_pass(
        "write samples", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(hits_, Access::storage_read_in_compute);
            pass.read(tables_, Access::storage_read_in_compute);
            pass.read(blocks, Access::storage_read_in_compute);
            static_cast<void>(pass.write(samples, Access::storage_write_in_compute));
        },
        [this](VkCommandBuffer commands) { dispatch_rows(commands, Step::write); });
    executor_ = graph::make_executor(device, graph_);
}

void ExportSamples::record(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                           const Item& item) {
    item_ = item;
    executor_->set_buffer(summaries_, item.summaries);
    executor_->set_buffer(blocks_, item.blocks);
    executor_->set_buffer(samples_, item.output);
    executor_->execute(graph_, commands, timestamps);
}

void ExportSamples::dispatch_count(VkCommandBuffer commands) const {
    device_->functions().vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                           pipeline_.get());
    std::uint32_t first_tile = 0;
    for (std::size_t i = 0; i < item_.runs.size(); ++i) {
        const plan::SampleRunOutput& run = item_.runs[i];
        bind(commands, item_.sets[2 * i]);
        dispatch(commands, Step::box, run.table, first_tile, run.tile_count, run.tile_count);
        first_tile += run.tile_count;
    }
    dispatch_rows(commands, Step::count);
}

void ExportSamples::dispatch_place(VkCommandBuffer commands) const {
    device_->functions().vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                           pipeline_.get());
    bind(commands, item_.sets.back());
    dispatch(commands, Step::place, 0, 0, item_.samples->tile_count, 1);
}

/// One thread per row of each tile; nothing if the samples are omitted.
void ExportSamples::dispatch_rows(VkCommandBuffer commands, Step step) const {
    if (item_.samples->block_count == 0) {
        return;
    }
    device_->functions().vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                           pipeline_.get());
    constexpr std::uint32_t words_of_tile = sizeof(plan::SampleTileData) / sizeof(std::uint32_t);
    for (std::size_t i = 0; i < item_.runs.size(); ++i) {
        const plan::SampleRunOutput& run = item_.runs[i];
        bind(commands, item_.sets[2 * i + 1]);
        for (std::uint32_t tile = 0; tile < run.tile_count; ++tile) {
            dispatch(commands, step, run.table + tile * words_of_tile, 0, item_.samples->tile_count,
                     item_.tiles[run.first_tile + tile].height);
        }
    }
}

void ExportSamples::bind(VkCommandBuffer commands, VkDescriptorSet set) const {
    device_->functions().vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_,
                                                 0, 1, &set, 0, nullptr);
}

void ExportSamples::dispatch(VkCommandBuffer commands, Step step, std::uint32_t table,
                             std::uint32_t first_tile, std::uint32_t tile_count,
                             std::uint32_t threads) const {
    const gpu::Functions& functions = device_->functions();
    const plan::SamplesOutput& samples = *item_.samples;
    const SamplesPush push{static_cast<std::uint32_t>(step),
                           table,
                           first_tile,
                           tile_count,
                           samples.block_count,
                           samples.capacity,
                           samples.rings.first_word,
                           samples.rings.count,
                           samples.vertices,
                           static_cast<float>(samples.cell)};
    functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push),
                                 &push);
    dispatch_threads(functions, commands, threads);
}

std::string ExportSamples::print(GraphFormat format) const {
    return graph::print(graph_, executor_->baked(), format);
}

}  // namespace nearfield::passes
