#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/computed_tiles.hpp>

#include <utility>

namespace nearfield::render {

using graph::Handle;

ComputeKey::ComputeKey(const device_input::ComputeBatch& batch)
    : field_values(batch.work.fields.values),
      field_features(batch.work.fields.features),
      field_points(!batch.work.fields.points.empty()),
      overlap(!batch.work.overlaps.empty()),
      keeps_hits(batch.keeps_hits) {}

ComputeGraph::ComputeGraph(const gpu::Device& device, const PipelineSet& passes,
                           const ComputeKey& needs)
    : needs_(needs) {
    const bool any_field = needs_.fields() || needs_.field_points;
    handles_.shapes = import_buffer({"shapes in tiles", true, false});
    if (any_field) {
        handles_.long_searches = import_buffer({"long searches", true, true});
        outputs_.field = import_buffer({"field results", false, true});
    }
    passes::Fields::Output output{handles_.long_searches, outputs_.field};
    if (needs_.fields() || needs_.overlap) {
        declare_masked(passes, output);
    }
    if (needs_.field_points) {
        passes.fields().declare_points(*this, handles_.shapes, output);
    }
    compile(device);
}

void ComputeGraph::declare_masked(const PipelineSet& passes, passes::Fields::Output& output) {
    // The pass that exports samples reads the masks once more.
    handles_.scratch =
        needs_.keeps_hits ? import_buffer({"scratch"}, {{}, graph::Access::storage_read_in_compute})
                          : import_buffer({"scratch", false, false});
    Handle scratch = handles_.scratch;
    passes.masks().declare_shapes(*this, handles_.shapes, scratch);
    if (needs_.overlap) {
        outputs_.samples = import_buffer({"samples", true, true});
        passes.masks().declare_collect(*this, handles_.shapes, scratch, outputs_.samples);
    }
    if (needs_.fields()) {
        handles_.crowd = import_buffer({"crowded blocks", true, false});
        passes.fields().declare_cells(*this, {handles_.shapes, scratch, handles_.crowd},
                                      {needs_.field_values, needs_.field_features}, output);
    }
}

std::unique_ptr<TileWork> ComputeTechnique::make_work() {
    return make_computed();
}

std::unique_ptr<ComputedTiles> ComputeTechnique::make_computed() {
    return std::make_unique<ComputedTiles>(*device_, *layout_, *this);
}

std::shared_ptr<const ComputeGraph> ComputeTechnique::graph_for(
    const device_input::ComputeBatch& batch) {
    const ComputeKey needs(batch);
    for (const auto& graph : graphs_) {
        if (graph->needs() == needs) {
            return graph;
        }
    }
    return graphs_.emplace_back(std::make_shared<ComputeGraph>(*device_, *passes_, needs));
}

ComputedTiles::ComputedTiles(const gpu::Device& device, const graph::ComputeLayout& layout,
                             ComputeTechnique& technique)
    : TileWork(device, layout, technique),
      technique_(&technique),
      words_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
             gpu::Direction::none, "nearfield resident words") {}

void ComputedTiles::build(const device_input::Plan& plan) {
    set_count(technique_->builder().build(plan, device().limits().maxStorageBufferRange, batches_));
}

void ComputedTiles::upload() {
    for (std::uint32_t number = 0; number < count(); ++number) {
        if (number == buffers_.size()) {
            buffers_.push_back(std::make_unique<ComputeBuffers>(device()));
        }
        buffers_[number]->upload(batches_[number]);
    }
}

void ComputedTiles::lay_out_output(graph::DescriptorUpdates& updates) {
    copies_.clear();
    TileWork::lay_out_output(updates);
    for (const std::uint32_t number : running()) {
        find_copies(number);
        buffers_[number]->empty_crowd();
    }
    if (!copies_.empty()) {
        bind_copies();
    }
}

void ComputedTiles::find_copies(std::uint32_t number) {
    const device_input::ComputeBatch& batch = batches_[number];
    if (!batch.resident) {
        return;
    }
    const OutputParts& parts = output(number);
    for (const device_input::WordRange& range : batch.field_read_back) {
        const std::uint64_t first = parts.field + range.first * sizeof(std::uint32_t);
        copies_.push_back({first, first, range.count * sizeof(std::uint32_t)});
    }
}

void ComputedTiles::bind_copies() {
    const passes::CopyBack& copy_back = technique_->passes().exports().copy_back;
    if (!bound_copies_) {
        bound_copies_.emplace(copy_back.graph.make_resources(layout()));
    }
    bound_copies_->set(copy_back.words, words_.part(0, words_.capacity()));
    bound_copies_->set(copy_back.read_back,
                       read_back_buffer().part(0, read_back_buffer().capacity()));
}

std::span<const ResidentBuffers::Words> ComputedTiles::words(gpu::BufferPart& none) {
    words_.reserve(smallest_part);
    none = words_.part(0, smallest_part);
    resident_words_.clear();
    for (std::uint32_t number = 0; number < count(); ++number) {
        const OutputParts& parts = output(number);
        const gpu::MappedBuffer& words = words_of(number);
        resident_words_.push_back(
            {words.part(parts.field, parts.summaries - parts.field),
             read_back_buffer().part(parts.summaries, parts.samples - parts.summaries),
             buffers_[number]->scratch()});
    }
    return resident_words_;
}

void ComputedTiles::bind_input(std::uint32_t number, graph::BoundResources& resources) {
    if (batches_[number].resident) {
        words_.reserve(read_back_buffer().capacity());
    }
    buffers_[number]->bind(graph_of<ComputeGraph>(number).handles(), resources);
}

std::size_t ComputedTiles::pass_count() const {
    return TileWork::pass_count() +
           (copies_.empty() ? 0 : technique_->passes().exports().copy_back.graph.passes().size());
}

void ComputedTiles::record_tiles(std::uint32_t number, const graph::BoundResources& resources,
                                 std::uint32_t sample_capacity, VkCommandBuffer commands,
                                 gpu::Timestamps& timestamps) const {
    const passes::RecordContext context{batches_[number], buffers_[number]->shape_units(),
                                        sample_capacity};
    graph_of<ComputeGraph>(number).execute(commands, timestamps, resources, context);
}

void ComputedTiles::record(VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
    TileWork::record(commands, timestamps);
    if (!copies_.empty()) {
        technique_->passes().exports().copy_back.graph.execute(commands, timestamps, *bound_copies_,
                                                               copies_);
    }
}

}  // namespace nearfield::render
