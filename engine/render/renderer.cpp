#include <engine/base/stopwatch.hpp>
#include <engine/graph/format.hpp>
#include <engine/render/renderer.hpp>

#include <algorithm>

namespace nearfield::render {
namespace {

// Compiled graphs that keep their images: more than the kinds of batches that alternate in
// practice.
constexpr std::size_t max_graphs = 8;

// Elements that a search makes room for, if none has found more.
constexpr std::uint32_t min_expected = 4096;

ComputeKey compute_key_of(const plan::TileBatch& batch) {
    const plan::ComputeWork& work = batch.compute;
    ComputeKey needs;
    needs.field_values = work.fields.values;
    needs.field_features = work.fields.features;
    needs.field_points = !work.fields.points.empty();
    needs.fields = work.fields.values || work.fields.features;
    needs.overlap = !work.overlaps.empty();
    needs.keeps_hits = batch.keeps_hits;
    return needs;
}

GraphKey key_of(const plan::TileBatch& batch) {
    GraphKey needs;
    if (batch.by_compute) {
        needs.compute = compute_key_of(batch);
        return needs;
    }
    needs.points = !batch.points.empty();
    needs.field_points = !batch.field_point_runs.empty();
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        needs.overlap[i] = !batch.raster.overlaps[i].empty();
    }
    for (const plan::FieldTile& field : batch.field_tiles) {
        needs.field[static_cast<std::size_t>(field.sign)] = true;
        needs.field_cells = needs.field_cells || field.first_value != plan::not_asked ||
                            field.first_feature != plan::not_asked;
    }
    needs.blended = batch.raster.meshes.range(plan::TileMeshId::gradients).count > 0;
    return needs;
}

}  // namespace

Renderer::Renderer(const gpu::Device& device, const Settings& settings)
    : device_(&device),
      timestamps_(settings.timestamps),
      layout_(device, passes::max_push_bytes),
      passes_(device, layout_) {
    if (!settings.pipelines_on_demand) {
        passes_.make(settings.techniques);
    }
}

const char* Renderer::gradient_format() const {
    return graph::find_format(device_->gradient_format())->name;
}

std::unique_ptr<BatchResources> Renderer::make_resources() {
    return std::make_unique<BatchResources>(*device_, layout_, passes_, timestamps_);
}

std::unique_ptr<PairSearchBuffers> Renderer::make_pair_buffers(const plan::PairQuestion& question) {
    return std::make_unique<PairSearchBuffers>(
        *device_, layout_, passes_.pair_search(question.kind()), question, timestamps_);
}

std::unique_ptr<WorldQueryBuffers> Renderer::make_world_query_buffers(
    plan::WorldQuestion question) {
    return std::make_unique<WorldQueryBuffers>(*device_, layout_, passes_.world_queries(question),
                                               question, timestamps_);
}

/// Batches in flight share ownership of the graph they use, so it may be replaced here.
std::shared_ptr<CompiledGraph> Renderer::graph_for(GraphKey needs, plan::TileSize extent) {
    constexpr std::uint32_t gap = plan::atlas_gap;
    VkExtent2D atlas{plan::smallest_atlas + gap, plan::smallest_atlas + gap};
    bool grows = false;
    for (const auto& graph : graphs_) {
        if (graph->needs() == needs) {
            if (graph->extent().width >= extent.width && graph->extent().height >= extent.height) {
                return graph;
            }
            atlas = graph->extent();
            grows = true;
        }
    }
    // Powers of two and a gap, so that an atlas that grows a little each frame is not recreated
    // each frame.
    while (atlas.width < extent.width) {
        atlas.width = 2 * (atlas.width - gap) + gap;
    }
    while (atlas.height < extent.height) {
        atlas.height = 2 * (atlas.height - gap) + gap;
    }
    device_->log(grows ? LogLevel::warning : LogLevel::information, [&] {
        return std::string(grows ? "images grow to " : "images for a new kind of batch: ") +
               std::to_string(atlas.width) + " x " + std::to_string(atlas.height);
    });
    last_graph_ = nullptr;
    std::erase_if(graphs_, [&](const auto& graph) { return graph->needs() == needs; });
    if (graphs_.size() == max_graphs) {
        graphs_.erase(graphs_.begin());
    }
    graphs_.push_back(std::make_shared<CompiledGraph>(*device_, passes_, needs, atlas));
    return graphs_.back();
}

std::uint32_t Renderer::sample_capacity(const plan::TileBatch& batch, SampleRoom room) const {
    if (room == SampleRoom::all) {
        return static_cast<std::uint32_t>(batch.listed_cells);
    }
    const std::uint64_t expected =
        std::max<std::uint64_t>(max_samples_, 4096 + batch.listed_cells / 8);
    return static_cast<std::uint32_t>(std::min(batch.listed_cells, expected));
}

void Renderer::prepare(std::span<const plan::TileBatch> tile_batches,
                       const plan::ResidentOutputs& resident, plan::TileSize extent,
                       SampleRoom room, BatchResources& slot, Timings& timings) {
    const Stopwatch start;
    const double made = pipeline_milliseconds();
    slot.upload(tile_batches, resident);
    last_had_fields_ = !resident.fields.empty();
    last_had_records_ = !resident.records.empty();
    last_had_samples_ = !resident.samples.empty();
    if (last_had_fields_ || last_had_records_ || last_had_samples_) {
        static_cast<void>(passes_.exports());
    }
    last_graph_.reset();
    last_pairs_.reset();
    last_question_.reset();
    slot.run(static_cast<std::uint32_t>(tile_batches.size()));
    for (const std::uint32_t number : slot.running()) {
        TileBatchOnDevice& on_device = slot.tile_batch(number);
        on_device.graph = graph_for(key_of(tile_batches[number]), extent);
        on_device.sample_capacity = sample_capacity(tile_batches[number], room);
        last_graph_ = on_device.graph;
    }
    slot.lay_out_output();
    timings.plan += start.milliseconds() - (pipeline_milliseconds() - made);
}

void Renderer::prepare_search(const plan::SearchShapes& shapes, const plan::GivenPairs& pairs,
                              SampleRoom room, BatchResources& slot, Timings& timings) {
    const Stopwatch start;
    // What stays on the device is not written again with more room.
    room = last_had_records_ ? SampleRoom::all : room;
    const double made = pipeline_milliseconds();
    last_had_search_ = !pairs.directions.empty();
    if (last_had_search_) {
        PairCounts expected{};
        for (std::size_t i = 0; i < expected.size(); ++i) {
            expected[i] =
                room == SampleRoom::all ? UINT32_MAX : std::max(min_expected, max_counts_[i]);
        }
        expected[plan::row_total] = UINT32_MAX;  // of all pairs
        slot.upload_search(shapes, pairs, expected);
    }
    timings.plan += start.milliseconds() - (pipeline_milliseconds() - made);
}

void Renderer::submit(BatchResources& slot, const Submission& order, Timings& timings) {
    const Stopwatch start;
    record_tile_batches(slot, slot.begin());
    timings.record += start.milliseconds();
    slot.submit(order);
}

void Renderer::record(BatchResources& slot, VkCommandBuffer commands, std::uint32_t stamp,
                      Timings& timings) {
    const Stopwatch start;
    device_->begin_label(commands, "nearfield");
    record_tile_batches(slot, commands);
    slot.end_recording(commands, stamp);
    device_->end_label(commands);
    timings.record += start.milliseconds();
}

bool Renderer::submit_those_without_room(BatchResources& slot, Timings& timings) {
    slot.run_those_without_room();
    if (slot.running().empty() && slot.running_search() == nullptr) {
        return false;
    }
    slot.lay_out_output();
    submit(slot, {}, timings);
    return true;
}

void Renderer::record_tile_batches(BatchResources& slot, VkCommandBuffer commands) {
    slot.timestamps().reset(commands);
    for (const std::uint32_t number : slot.running()) {
        const TileBatchOnDevice& on_device = slot.tile_batch(number);
        const passes::RecordContext context = slot.record_context(number);
        if (!context.batch.by_compute) {
            passes_.raster().early_out.reset(commands, context);
        }
        on_device.graph->graph().execute(commands, slot.timestamps(), slot.bound(number), context);
    }
    if (const GivenSearch* const search = slot.running_search()) {
        record_search(*search, slot, commands);
    }
    record_exports(slot, commands);
}

/// The parts take turns with the memory that records are exported from.
void Renderer::record_search(const GivenSearch& search, BatchResources& slot,
                             VkCommandBuffer commands) {
    const SearchMemory& memory = search.found();
    for (std::size_t i = 0; i < memory.parts(); ++i) {
        memory.record(i, commands, slot.timestamps());
        if (slot.has_resident_outputs()) {
            slot.resident().record_records(memory.part(i).input().push, passes_.exports().records,
                                           commands, slot.timestamps());
        }
    }
}

void Renderer::record_exports(BatchResources& slot, VkCommandBuffer commands) {
    if (!slot.copies().empty()) {
        passes_.exports().copy_back.graph.execute(commands, slot.timestamps(), slot.bound_copies(),
                                                  slot.copies());
    }
    if (slot.has_resident_outputs()) {
        slot.resident().record(passes_.exports(), commands, slot.timestamps());
    }
}

void Renderer::trim() noexcept {
    last_graph_ = nullptr;
    graphs_.clear();
    max_counts_ = {};
    max_samples_ = 0;
    expected_records_ = min_records;
}

void Renderer::wait(BatchResources& slot, Timings& timings) {
    slot.wait();
    slot.timestamps().collect(timings.passes);
    if (const GivenSearch* const search = slot.running_search()) {
        const PairCounts& counts = search->counts();
        for (std::size_t i = 0; i < counts.size(); ++i) {
            // A little more, so that a scene that grows slowly is seldom submitted again.
            max_counts_[i] = std::max(max_counts_[i], counts[i] + counts[i] / 8);
        }
    }
    for (const std::uint32_t number : slot.running()) {
        max_samples_ = std::max(max_samples_, slot.tile_batch(number).sample_count);
    }
}

std::string Renderer::print(GraphFormat format) const {
    std::string text;
    const auto add = [&](const auto& graph, const char* title) {
        text += graph.print(format, title);
    };
    if (last_question_) {
        add(passes_.world_queries(*last_question_).graph, "questions about a world");
        return text;
    }
    if (last_pairs_) {
        if (last_pairs_->takes_poses) {
            add(pair_poses().graph, "poses of pairs");
        }
        add(passes_.pair_search(last_pairs_->kind), "pairs");
        if (last_pairs_->is_resident) {
            add(export_pairs().graph, "resident pairs");
        }
        return text;
    }
    if (last_graph_ != nullptr) {
        add(last_graph_->graph(), "tiles");
    }
    if (last_had_search_) {
        add(passes_.pair_search(plan::given_pairs), "search for points");
    }
    if (last_had_fields_) {
        add(passes_.exports().field.graph, "resident fields");
    }
    if (last_had_records_) {
        add(passes_.exports().records.graph, "resident records");
    }
    if (last_had_samples_) {
        add(passes_.exports().samples.graph, "resident samples");
    }
    if (last_had_fields_ || last_had_records_ || last_had_samples_) {
        add(passes_.exports().headers.graph, "resident headers");
    }
    return text;
}

}  // namespace nearfield::render
