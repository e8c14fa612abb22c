#include <engine/base/stopwatch.hpp>
#include <engine/graph/format.hpp>
#include <engine/render/renderer.hpp>

#include <algorithm>

namespace nearfield::render {
namespace {

// Elements that a search makes room for, if none has found more.
constexpr std::uint32_t min_expected = 4096;

}  // namespace

Renderer::Renderer(const gpu::Device& device, const Settings& settings,
                   MakeTileTechnique make_drawn)
    : device_(&device),
      timestamps_(settings.timestamps),
      layout_(device, passes::max_push_bytes),
      passes_(device, layout_),
      computed_(device, layout_, passes_) {
    const auto make_raster = [&] {
        if (settings.techniques.raster) {
            drawn_ = make_drawn(device, layout_, !settings.pipelines_on_demand);
        }
    };
    if (settings.pipelines_on_demand) {
        make_raster();
    } else {
        Jobs jobs(settings.jobs);
        passes_.make(settings.techniques, jobs, make_raster);
    }
}

const char* Renderer::gradient_format() const {
    return graph::find_format(device_->gradient_format())->name;
}

std::unique_ptr<BatchResources> Renderer::make_resources() {
    return std::make_unique<BatchResources>(*device_, layout_, passes_, drawn_.get(), computed_,
                                            timestamps_);
}

std::unique_ptr<PairSearchBuffers> Renderer::make_pair_buffers(
    const device_input::PairQuestion& question, const PairTableCounts& reserve) {
    return std::make_unique<PairSearchBuffers>(
        *device_, layout_, passes_.pair_search(question.kind()), question, reserve, timestamps_);
}

std::unique_ptr<WorldQueryBuffers> Renderer::make_world_query_buffers(
    device_input::WorldQuestion question) {
    return std::make_unique<WorldQueryBuffers>(*device_, layout_, passes_.world_queries(question),
                                               question, timestamps_);
}

void Renderer::prepare(const device_input::ResidentOutputs& resident,
                       const device_input::SearchShapes& shapes,
                       const device_input::GivenPairs& pairs, SampleRoom room, BatchResources& slot,
                       Timings& timings) {
    const Stopwatch start;
    const double made = pipeline_milliseconds();
    forget_last_graphs();
    slot.prepare(resident, room);
    slot.lay_out_output();
    if (!pairs.directions.empty()) {
        // What stays on the device is not written again with more room.
        upload_search(shapes, pairs, resident.records.empty() ? room : SampleRoom::all, slot);
        note_search(passes_.pair_search(device_input::given_pairs), "search for points");
    }
    if (!resident.fields.empty()) {
        last_graphs_.push_back({&passes_.exports().field.graph, "resident fields"});
    }
    if (!resident.records.empty()) {
        last_graphs_.push_back({&passes_.exports().records.graph, "resident records"});
    }
    if (!resident.samples.empty()) {
        last_graphs_.push_back({&passes_.exports().samples.graph, "resident samples"});
    }
    timings.plan += start.milliseconds() - (pipeline_milliseconds() - made);
}

void Renderer::upload_search(const device_input::SearchShapes& shapes,
                             const device_input::GivenPairs& pairs, SampleRoom room,
                             BatchResources& slot) {
    PairCounts expected{};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        expected[i] = room == SampleRoom::all ? UINT32_MAX : std::max(min_expected, max_counts_[i]);
    }
    expected[shaders::row_total] = UINT32_MAX;  // of all pairs
    slot.upload_search(shapes, pairs, expected);
}

void Renderer::submit(BatchResources& slot, const Submission& order, Timings& timings) {
    const Stopwatch start;
    record(slot, slot.begin());
    timings.record += start.milliseconds();
    slot.submit(order);
}

void Renderer::record(BatchResources& slot, VkCommandBuffer commands, std::uint32_t stamp,
                      Timings& timings) {
    const Stopwatch start;
    device_->begin_label(commands, "nearfield");
    record(slot, commands);
    slot.end_recording(commands, stamp);
    device_->end_label(commands);
    timings.record += start.milliseconds();
}

bool Renderer::submit_those_without_room(BatchResources& slot, Timings& timings) {
    if (!slot.select_those_without_room()) {
        return false;
    }
    slot.lay_out_output();
    submit(slot, {}, timings);
    return true;
}

void Renderer::record(BatchResources& slot, VkCommandBuffer commands) {
    slot.timestamps().reset(commands);
    for (const auto& tiles : slot.tiles()) {
        tiles->record(commands, slot.timestamps());
    }
    if (const GivenSearch* const search = slot.running_search()) {
        record_search(*search, slot, commands);
    }
    if (slot.has_resident_outputs()) {
        slot.resident().record(passes_.exports(), commands, slot.timestamps());
    }
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

void Renderer::trim() noexcept {
    if (drawn_ != nullptr) {
        drawn_->trim();
    }
    computed_.trim();
    max_counts_ = {};
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
}

void Renderer::forget_last_graphs() {
    last_graphs_.clear();
    if (drawn_ != nullptr) {
        drawn_->set_last_graph(nullptr);
    }
    computed_.set_last_graph(nullptr);
}

void Renderer::note_search(const passes::PairSearch& search, const char* title) {
    if (search.boxes() != nullptr) {
        last_graphs_.push_back({&search.boxes()->graph, "boxes of pairs"});
    }
    last_graphs_.push_back({&search.part().graph, title});
}

void Renderer::note_pairs(const device_input::PairSearchKind& kind, bool takes_poses,
                          bool is_resident) {
    forget_last_graphs();
    if (takes_poses) {
        last_graphs_.push_back({&pair_poses().graph, "poses of pairs"});
    }
    note_search(passes_.pair_search(kind), "pairs");
    if (is_resident) {
        last_graphs_.push_back({&export_pairs().graph, "resident pairs"});
    }
}

void Renderer::note_world_queries(device_input::WorldQuestion question) {
    forget_last_graphs();
    last_graphs_.push_back({&passes_.world_queries(question).graph, "questions about a world"});
}

std::string Renderer::print(GraphFormat format) const {
    std::string text = drawn_ == nullptr ? "" : drawn_->print(format, "tiles");
    text += computed_.print(format, "computed tiles");
    for (const TitledGraph& last : last_graphs_) {
        text += last.graph->print(format, last.title);
    }
    return text;
}

}  // namespace nearfield::render
