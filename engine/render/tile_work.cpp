#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/tile_work.hpp>
#include <passes/compute_shader.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield::render {
namespace {

template <class Element>
std::span<const Element> elements_at(const gpu::MappedBuffer& buffer, std::uint64_t offset,
                                     std::uint64_t count) {
    return {reinterpret_cast<const Element*>(buffer.data() + offset), count};
}

}  // namespace

TileWork::TileWork(const gpu::Device& device, const graph::ComputeLayout& layout,
                   TileTechnique& technique)
    : device_(&device),
      layout_(&layout),
      technique_(&technique),
      read_back_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                 gpu::Direction::readback, "nearfield read-back") {}

std::uint64_t TileWork::align(std::uint64_t offset) const {
    const std::uint64_t step =
        std::max<std::uint64_t>(device_->limits().minStorageBufferOffsetAlignment, smallest_part);
    return (offset + step - 1) / step * step;
}

void TileWork::prepare(SampleRoom room) {
    bound_.resize(std::max<std::size_t>(bound_.size(), count_));
    states_.resize(count_);
    running_.clear();
    technique_->set_last_graph(nullptr);
    if (count_ == 0) {
        return;
    }
    upload();
    for (std::uint32_t number = 0; number < count_; ++number) {
        State& state = states_[number];
        state.of = graph_for(number);
        state.sample_capacity = technique_->sample_capacity(batch(number).listed_cells, room);
        technique_->set_last_graph(state.of.graph);
        running_.push_back(number);
    }
}

void TileWork::select_those_without_room() {
    std::erase_if(running_, [&](std::uint32_t number) { return states_[number].had_room(); });
    for (const std::uint32_t number : running_) {
        states_[number].sample_capacity = states_[number].sample_count;
    }
}

void TileWork::lay_out_output(graph::DescriptorUpdates& updates) {
    if (running_.empty()) {
        return;
    }
    std::uint64_t end = 0;
    for (const std::uint32_t number : running_) {
        const device_input::TileBatch& batch = this->batch(number);
        const std::uint64_t point_bytes = batch.points.size() * sizeof(std::uint32_t);
        const std::uint64_t field_bytes = batch.field_words * sizeof(std::uint32_t);
        const std::uint64_t summary_bytes = batch.tiles.size() * sizeof(shaders::TileSummary);
        const std::uint64_t sample_bytes =
            sizeof(std::uint32_t) + states_[number].sample_capacity * sizeof(shaders::SampleData);
        require_range(*device_, std::max({point_bytes, field_bytes, summary_bytes, sample_bytes}),
                      "the results");
        OutputParts& parts = states_[number].output;
        parts.points = align(end);
        parts.field = align(parts.points + point_bytes);
        parts.summaries = align(parts.field + field_bytes);
        parts.samples = align(parts.summaries + summary_bytes);
        parts.end = parts.samples + sample_bytes;
        end = parts.end + smallest_part;
    }
    read_back_.reserve(end);
    for (const std::uint32_t number : running_) {
        empty_output(number);
        bind(number, updates);
    }
    read_back_.flush();
}

void TileWork::empty_output(std::uint32_t number) const {
    const shaders::TileSummary empty;
    const OutputParts& parts = states_[number].output;
    std::memset(read_back_.data() + parts.samples, 0, sizeof(std::uint32_t));
    for (std::size_t i = 0; i < batch(number).tiles.size(); ++i) {
        std::memcpy(read_back_.data() + parts.summaries + i * sizeof(empty), &empty, sizeof(empty));
    }
}

graph::BoundResources& TileWork::Bound::use(
    const std::shared_ptr<const graph::CompiledGraph>& graph, const graph::ComputeLayout& layout) {
    current = nullptr;
    std::erase_if(all, [](const WithGraph& one) { return one.graph.expired(); });
    const auto found = std::find_if(all.begin(), all.end(), [&graph](const WithGraph& one) {
        return one.graph.lock() == graph;
    });
    if (found == all.end()) {
        all.push_back(
            {graph, std::make_unique<graph::BoundResources>(graph->make_resources(layout))});
        current = all.back().resources.get();
    } else {
        current = found->resources.get();
    }
    return *current;
}

void TileWork::bind(std::uint32_t number, graph::DescriptorUpdates& updates) {
    const State& state = states_[number];
    const OutputParts& parts = state.output;
    const OutputHandles& handles = state.of.outputs;
    graph::BoundResources& resources = bound_[number].use(state.of.graph, *layout_);
    bind_input(number, resources);
    const gpu::MappedBuffer& words = words_of(number);
    resources.set(handles.results, read_back_.part(parts.points, parts.field - parts.points));
    resources.set(handles.field, words.part(parts.field, parts.summaries - parts.field));
    resources.set(handles.samples,
                  read_back_.part(parts.summaries, parts.samples - parts.summaries),
                  passes::sample_parts::summaries);
    resources.set(handles.samples, read_back_.part(parts.samples, parts.end - parts.samples),
                  passes::sample_parts::samples);
    updates.add(resources);
}

std::size_t TileWork::pass_count() const {
    std::size_t passes = 0;
    for (const std::uint32_t number : running_) {
        passes += states_[number].of.graph->passes().size();
    }
    return passes;
}

void TileWork::record(VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
    for (const std::uint32_t number : running_) {
        record_tiles(number, *bound_[number].current, states_[number].sample_capacity, commands,
                     timestamps);
    }
}

void TileWork::read_back() {
    if (running_.empty()) {
        return;
    }
    read_back_.invalidate();
    for (const std::uint32_t number : running_) {
        State& state = states_[number];
        std::memcpy(&state.sample_count, read_back_.data() + state.output.samples,
                    sizeof(state.sample_count));
        technique_->note_samples(state.sample_count);
    }
}

void TileWork::release() {
    for (State& state : states_) {
        state.of.graph = nullptr;
    }
}

std::span<const std::uint32_t> TileWork::points(std::uint32_t number) const {
    return elements_at<std::uint32_t>(read_back_, output(number).points,
                                      batch(number).points.size());
}

std::span<const std::uint32_t> TileWork::field_words(std::uint32_t number) const {
    return elements_at<std::uint32_t>(read_back_, output(number).field, batch(number).field_words);
}

std::span<const shaders::TileSummary> TileWork::summaries(std::uint32_t number) const {
    return elements_at<shaders::TileSummary>(read_back_, output(number).summaries,
                                             batch(number).tiles.size());
}

std::span<const shaders::SampleData> TileWork::samples(std::uint32_t number) const {
    return elements_at<shaders::SampleData>(
        read_back_, output(number).samples + sizeof(std::uint32_t), states_[number].sample_count);
}

}  // namespace nearfield::render
