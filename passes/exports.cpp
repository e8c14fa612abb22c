#include <engine/graph/access.hpp>
#include <passes/exports.hpp>

#include <shaders/export_field_comp.hpp>
#include <shaders/export_records_comp.hpp>
#include <shaders/export_samples_comp.hpp>

namespace nearfield::passes {

using graph::Access;

namespace {

constexpr graph::ExternalAccess exported_image{Access::exported_image, Access::exported_image};
constexpr graph::ExternalAccess exported_buffer{Access::exported_buffer, Access::exported_buffer};
/// As the graphs of tile batches leave it.
constexpr graph::ExternalAccess after_tiles{write, {}};

void dispatch_parts(const ComputeShader& shader, const graph::PassCommands& commands,
                    const ExportField::Input& input) {
    for (std::size_t i = 0; i < input.parts.size(); ++i) {
        const shaders::ExportFieldPush& cells = input.parts[i].cells;
        shader.bind_set(commands, commands.set_of(input.resources[i]));
        shader.push(commands, cells);
        shader.dispatch_cells(commands, cells.width, cells.height);
    }
}

/// `threads` threads of a step.
void dispatch_records(const ComputeShader& shader, VkCommandBuffer commands,
                      const ExportRecords::Input& input, std::uint32_t step,
                      std::uint32_t threads) {
    shaders::SearchPush push = input.push;
    push.stage = step;
    shader.push(commands, push);
    shader.dispatch_threads(commands, threads);
}

// The sets of the first pass: its shader finds either at the same binding.
constexpr std::uint32_t with_summaries = 0;
constexpr std::uint32_t with_masks = 1;

/// Dispatches `threads` threads. `table`, `first_tile`, `tile_count`: as in the shader.
void dispatch_step(const ComputeShader& shader, VkCommandBuffer commands,
                   const device_input::SamplesOutput& samples, std::uint32_t step,
                   std::uint32_t table, std::uint32_t first_tile, std::uint32_t tile_count,
                   std::uint32_t threads) {
    shader.push(commands,
                shaders::ExportSamplesPush{step, table, first_tile, tile_count, samples.block_count,
                                           samples.capacity, static_cast<float>(samples.cell),
                                           device_input::rounded(samples.origin)});
    shader.dispatch_threads(commands, threads);
}

/// One thread per row of each tile; nothing if the samples are omitted.
void dispatch_rows(const ComputeShader& shader, const graph::PassCommands& commands,
                   const ExportSamples::Input& input, std::uint32_t set, std::uint32_t step) {
    for (std::size_t i = 0; input.samples->block_count > 0 && i < input.runs.size(); ++i) {
        const device_input::SampleRunOutput& run = input.runs[i];
        shader.bind_set(commands, commands.set_of(input.resources[i], set));
        for (std::uint32_t tile = 0; tile < run.tile_count; ++tile) {
            dispatch_step(shader, commands, *input.samples, step,
                          run.table + tile * shaders::words_of_tile, 0, input.samples->tile_count,
                          input.tiles[run.first_tile + tile].height);
        }
    }
}

void dispatch_count(const ComputeShader& shader, const graph::PassCommands& commands,
                    const ExportSamples::Input& input) {
    std::uint32_t first_tile = 0;
    for (std::size_t i = 0; i < input.runs.size(); ++i) {
        const device_input::SampleRunOutput& run = input.runs[i];
        shader.bind_set(commands, commands.set_of(input.resources[i], with_summaries));
        dispatch_step(shader, commands, *input.samples, shaders::box_step, run.table, first_tile,
                      run.tile_count, run.tile_count);
        first_tile += run.tile_count;
    }
    dispatch_rows(shader, commands, input, with_masks, shaders::count_step);
}

}  // namespace

CopyBack::CopyBack(const gpu::Device& device)
    : words(graph.import_buffer({"words"}, after_tiles)),
      read_back(graph.import_buffer({"read-back", false, true})) {
    graph.add_pass(
        "copy back", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(words, Access::transfer_read);
            static_cast<void>(pass.write(read_back, Access::transfer_write));
        },
        [this, &device](const graph::PassCommands& commands, std::span<const VkBufferCopy> ranges) {
            device.functions().vkCmdCopyBuffer(
                commands, commands.part(words).buffer, commands.part(read_back).buffer,
                static_cast<std::uint32_t>(ranges.size()), ranges.data());
        });
    graph.compile(device);
}

CopyHeader::CopyHeader(const gpu::Device& device)
    : header(graph.import_buffer({"resident header"}, {write, Access::exported_buffer})),
      target(graph.import_buffer({"header of the host"}, exported_buffer)) {
    graph.add_pass(
        "copy header", graph::PassKind::compute,
        [this](graph::PassBuilder& pass) {
            pass.read(header, Access::transfer_read);
            static_cast<void>(pass.write(target, Access::transfer_write));
        },
        [this, &device](const graph::PassCommands& commands, const Input&) {
            const gpu::BufferPart& from = commands.part(header);
            const gpu::BufferPart& to = commands.part(target);
            const VkBufferCopy range{from.offset, to.offset, to.bytes};
            device.functions().vkCmdCopyBuffer(commands, from.buffer, to.buffer, 1, &range);
        });
    graph.compile(device);
}

ExportField::ExportField(const gpu::Device& device, const graph::ComputeLayout& layout)
    : shader(device, layout, shaders::export_field_comp, "nearfield export field"),
      words(graph.import_buffer({"field results"}, after_tiles)),
      tables(graph.import_buffer({"tables", true, false})),
      signed_distance(
          graph.import_image({"signed distance", VK_FORMAT_R32_SFLOAT}, exported_image)),
      feature(graph.import_image({"feature id", VK_FORMAT_R32_UINT}, exported_image)),
      header(graph.import_buffer({"resident header"}, exported_buffer)) {
    graph::Handle written = header;
    graph::Handle distances = signed_distance;
    graph::Handle features = feature;
    add_pass(graph, "export field", shader,
             {{0, words},
              {1, tables},
              {6, distances, Access::storage_image_in_compute},
              {7, features, Access::storage_image_in_compute},
              {3, written, write}},
             dispatch_parts);
    graph.compile(device);
}

// A search that takes the same scratch memory waits for the one before, and so for this.
ExportRecords::ExportRecords(const gpu::Device& device, const graph::ComputeLayout& layout)
    : shader(device, layout, shaders::export_records_comp, "nearfield export records"),
      shapes(graph.import_buffer({"pair shapes", true, false})),
      scratch(graph.import_buffer({"pair scratch"}, after_tiles)),
      header(graph.import_buffer({"resident header"}, exported_buffer)),
      records(graph.import_buffer({"records"}, exported_buffer)) {
    graph::Handle counted = header;
    graph::Handle output = records;
    // The first pass writes no record, and the last one only reads what was counted. Both are
    // declared as writes: they share a shader that writes either, and to validation layers that is
    // an access.
    add_pass(graph, "count records", shader,
             {{0, shapes}, {1, scratch}, {3, counted, write}, {2, output, write}},
             [](const ComputeShader& of, VkCommandBuffer commands, const Input& input) {
                 dispatch_records(of, commands, input, shaders::count_step, input.blocks);
             });
    add_pass(graph, "place records", shader,
             {{0, shapes}, {1, scratch}, {3, counted, write}, {2, output, write}},
             [](const ComputeShader& of, VkCommandBuffer commands, const Input& input) {
                 dispatch_records(of, commands, input, shaders::place_step, 1);
             });
    add_pass(graph, "write records", shader,
             {{0, shapes}, {1, scratch}, {3, counted, write}, {2, output, write}},
             [](const ComputeShader& of, VkCommandBuffer commands, const Input& input) {
                 dispatch_records(of, commands, input, shaders::write_step,
                                  shaders::points_per_block * input.blocks);
             });
    graph.compile(device);
}

// The graphs of the tile batches leave their masks readable (render::CompiledGraph).
ExportSamples::ExportSamples(const gpu::Device& device, const graph::ComputeLayout& layout)
    : shader(device, layout, shaders::export_samples_comp, "nearfield export samples"),
      summaries(graph.import_buffer({"tile summaries"}, after_tiles)),
      masks(graph.import_buffer({"masks"}, {read, {}})),
      tables(graph.import_buffer({"tables", true, false})),
      header(graph.import_buffer({"resident header"}, exported_buffer)),
      samples(graph.import_buffer({"resident samples"}, exported_buffer)) {
    graph::Handle counted = header;
    graph::Handle output = samples;
    // The first pass writes no sample, and the last one no counts; see ExportRecords.
    add_pass(graph, "count samples", shader,
             {{0, summaries, read, 0, with_summaries},
              {0, masks, read, 0, with_masks},
              {1, tables},
              {3, counted, write},
              {2, output, write}},
             dispatch_count);
    add_pass(graph, "place samples", shader, {{3, counted, write}, {2, output, write}},
             [](const ComputeShader& of, VkCommandBuffer commands, const Input& input) {
                 dispatch_step(of, commands, *input.samples, shaders::place_step, 0, 0,
                               input.samples->tile_count, 1);
             });
    add_pass(graph, "write samples", shader,
             {{0, masks}, {1, tables}, {3, counted, write}, {2, output, write}},
             [](const ComputeShader& of, const graph::PassCommands& commands, const Input& input) {
                 dispatch_rows(of, commands, input, 0, shaders::write_step);
             });
    graph.compile(device);
}

}  // namespace nearfield::passes
