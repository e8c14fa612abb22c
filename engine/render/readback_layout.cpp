#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/batch_resources.hpp>

#include <algorithm>
#include <cstring>

// Layout of the outputs of a batch's tile batches.
namespace nearfield::render {

void BatchResources::lay_out_output() {
    std::uint64_t end = 0;
    for (const std::uint32_t number : running_) {
        TileBatchOnDevice& on_device = tile_batches_[number];
        const plan::TileBatch& batch = *on_device.batch;
        const std::uint64_t point_bytes = batch.points.size() * sizeof(std::uint32_t);
        const std::uint64_t field_bytes = batch.field_words * sizeof(std::uint32_t);
        const std::uint64_t summary_bytes = batch.tiles.size() * sizeof(plan::TileSummary);
        const std::uint64_t sample_bytes =
            sizeof(std::uint32_t) + on_device.sample_capacity * sizeof(plan::SampleData);
        require_range(*device_, std::max({point_bytes, field_bytes, summary_bytes, sample_bytes}),
                      "the results");
        OutputParts& parts = on_device.output;
        parts.points = align(end);
        parts.field = align(parts.points + point_bytes);
        parts.summaries = align(parts.field + field_bytes);
        parts.samples = align(parts.summaries + summary_bytes);
        parts.end = parts.samples + sample_bytes;
        end = parts.end + smallest_part;
    }
    stamp_offset_ = align(end);
    read_back_.reserve(stamp_offset_ + sizeof(stamp_));
    std::memset(read_back_.data() + stamp_offset_, 0, sizeof(stamp_));
    copies_.clear();
    reserve_words(end);
    updates_.begin();
    for (const std::uint32_t number : running_) {
        TileBatchOnDevice& on_device = tile_batches_[number];
        find_copies(on_device);
        empty_output(on_device);
        if (on_device.batch->by_compute) {
            compute_[number]->empty_crowd();
        }
        bind(number);
    }
    read_back_.flush();
    if (!copies_.empty()) {
        bind_copies();
    }
    if (has_resident_outputs_) {
        bind_export();
    }
    updates_.end();
    reserve_timestamps();
}

void BatchResources::reserve_timestamps() {
    std::size_t passes = 0;
    for (const std::uint32_t number : running_) {
        passes += tile_batches_[number].graph->graph().passes().size();
    }
    if (!copies_.empty()) {
        passes += pipelines_->exports().copy_back.graph.passes().size();
    }
    if (has_resident_outputs_) {
        passes += resident_.count_passes(pipelines_->exports());
    }
    passes_ = static_cast<std::uint32_t>(passes);
    timestamps_.reserve(passes_);
}

/// `end`: of the tile batches' parts of the read-back.
void BatchResources::reserve_words(std::uint64_t end) {
    const bool any_resident =
        std::any_of(running_.begin(), running_.end(),
                    [this](std::uint32_t number) { return tile_batches_[number].batch->resident; });
    if (any_resident || has_resident_outputs_) {
        words_.reserve(std::max(end, smallest_part));
    }
}

const gpu::MappedBuffer& BatchResources::words_of(const TileBatchOnDevice& on_device) const {
    return on_device.batch->resident ? words_ : read_back_;
}

void BatchResources::find_copies(const TileBatchOnDevice& on_device) {
    const plan::TileBatch& batch = *on_device.batch;
    if (!batch.resident) {
        return;
    }
    for (const plan::WordRange& range : batch.field_read_back) {
        const std::uint64_t first = on_device.output.field + range.first * sizeof(std::uint32_t);
        copies_.push_back({first, first, range.count * sizeof(std::uint32_t)});
    }
}

void BatchResources::bind_export() {
    const gpu::BufferPart none = words_.part(0, smallest_part);
    export_words_.clear();
    for (std::uint32_t number = 0; number < tile_batches_.size(); ++number) {
        const TileBatchOnDevice& on_device = tile_batches_[number];
        const OutputParts& parts = on_device.output;
        const gpu::MappedBuffer& words = words_of(on_device);
        export_words_.push_back({words.part(parts.field, parts.summaries - parts.field),
                                 read_back_.part(parts.summaries, parts.samples - parts.summaries),
                                 on_device.batch->by_compute ? compute_[number]->scratch() : none});
    }
    resident_.bind(export_words_, none, pipelines_->exports(), updates_);
}

void BatchResources::empty_output(const TileBatchOnDevice& on_device) const {
    const plan::TileSummary empty;
    const OutputParts& parts = on_device.output;
    std::memset(read_back_.data() + parts.samples, 0, sizeof(std::uint32_t));
    for (std::size_t i = 0; i < on_device.batch->tiles.size(); ++i) {
        std::memcpy(read_back_.data() + parts.summaries + i * sizeof(empty), &empty, sizeof(empty));
    }
}

void BatchResources::bind_copies() {
    const passes::CopyBack& copy_back = pipelines_->exports().copy_back;
    if (!bound_copies_) {
        bound_copies_.emplace(copy_back.graph.make_resources(*layout_));
    }
    bound_copies_->set(copy_back.words, words_.part(0, words_.capacity()));
    bound_copies_->set(copy_back.read_back, read_back_.part(0, read_back_.capacity()));
}

graph::BoundResources& BatchResources::Bound::use(const std::shared_ptr<CompiledGraph>& graph,
                                                  const graph::ComputeLayout& layout) {
    current = nullptr;
    std::erase_if(all, [](const WithGraph& one) { return one.graph.expired(); });
    const auto found = std::find_if(all.begin(), all.end(), [&graph](const WithGraph& one) {
        return one.graph.lock() == graph;
    });
    if (found == all.end()) {
        all.push_back({graph, std::make_unique<graph::BoundResources>(
                                  graph->graph().make_resources(layout))});
        current = all.back().resources.get();
    } else {
        current = found->resources.get();
    }
    return *current;
}

void BatchResources::bind(std::uint32_t number) {
    const TileBatchOnDevice& on_device = tile_batches_[number];
    const OutputParts& output = on_device.output;
    const TileHandles& handles = on_device.graph->handles();
    graph::BoundResources& resources = bound_[number].use(on_device.graph, *layout_);
    if (on_device.batch->by_compute) {
        compute_[number]->bind(handles, resources);
    } else {
        bind_input(on_device, resources);
    }
    const gpu::MappedBuffer& words = words_of(on_device);
    resources.set(handles.results, read_back_.part(output.points, output.field - output.points));
    resources.set(handles.field, words.part(output.field, output.summaries - output.field));
    resources.set(handles.samples,
                  read_back_.part(output.summaries, output.samples - output.summaries),
                  passes::sample_parts::summaries);
    resources.set(handles.samples, read_back_.part(output.samples, output.end - output.samples),
                  passes::sample_parts::samples);
    updates_.add(resources);
}

void BatchResources::bind_input(const TileBatchOnDevice& on_device,
                                graph::BoundResources& resources) const {
    const InputParts& input = on_device.input;
    const TileHandles& handles = on_device.graph->handles();
    const auto set = [&](std::uint32_t part, std::uint64_t from, std::uint64_t to) {
        resources.set(handles.input, input_.part(from, to - from), part);
    };
    set(passes::input_parts::tiles, input.tiles, input.groups_end);
    set(passes::input_parts::edges, input.geometry,
        input.geometry + bytes_of(on_device.batch->lists.geometry()));
    set(passes::input_parts::points, input.points, input.field_points);
    set(passes::input_parts::field_points, input.field_points, input.end);
    resources.set(handles.mesh, mesh_.part(0, mesh_.capacity()));
}

}  // namespace nearfield::render
