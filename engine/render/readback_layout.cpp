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
        const std::uint64_t point_bytes = batch.points.size() *
                                          (1 + (batch.resident ? plan::words_of_details : 0)) *
                                          sizeof(std::uint32_t);
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
    lay_out_words(end);
    layout_->begin_updates();
    for (const std::uint32_t number : running_) {
        TileBatchOnDevice& on_device = tile_batches_[number];
        find_copies(on_device);
        empty_output(on_device);
        if (on_device.batch->by_compute) {
            compute_[number]->empty_crowd();
            bind_compute(number);
        } else {
            bind(number);
        }
    }
    read_back_.flush();
    if (has_resident_outputs_) {
        bind_export();
    }
    layout_->end_updates();
}

/// `end`: of the tile batches' parts of the read-back.
void BatchResources::lay_out_words(std::uint64_t end) {
    bool any_resident = has_resident_outputs_;
    for (const std::uint32_t number : running_) {
        TileBatchOnDevice& on_device = tile_batches_[number];
        const plan::TileBatch& batch = *on_device.batch;
        const std::uint64_t hit_bytes =
            std::uint64_t{batch.raster.hit_words} * sizeof(std::uint32_t);
        require_range(*device_, hit_bytes, "the cells of intersections that stay");
        any_resident = any_resident || batch.resident || hit_bytes > 0;
        on_device.output.hits = align(end);
        end = on_device.output.hits + std::max(hit_bytes, smallest_part);
    }
    if (any_resident) {
        words_.reserve(std::max(end, smallest_part));
    }
}

BufferPart BatchResources::hits_of(std::uint32_t number) const {
    const TileBatchOnDevice& on_device = tile_batches_[number];
    const plan::TileBatch& batch = *on_device.batch;
    if (batch.by_compute) {
        return compute_[number]->scratch_part();
    }
    return {words_.handle(), on_device.output.hits,
            std::max(std::uint64_t{batch.raster.hit_words} * sizeof(std::uint32_t), smallest_part)};
}

VkBuffer BatchResources::words_of(const TileBatchOnDevice& on_device) const {
    return on_device.batch->resident ? words_.handle() : read_back_.handle();
}

void BatchResources::find_copies(const TileBatchOnDevice& on_device) {
    const plan::TileBatch& batch = *on_device.batch;
    if (!batch.resident) {
        return;
    }
    const auto copy = [this](std::uint64_t first_byte, std::uint64_t words) {
        copies_.push_back({first_byte, first_byte, words * sizeof(std::uint32_t)});
    };
    if (!batch.points.empty()) {
        copy(on_device.output.points, batch.points.size());
    }
    for (const plan::WordRange& range : batch.field_read_back) {
        copy(on_device.output.field + range.first * sizeof(std::uint32_t), range.count);
    }
}

void BatchResources::bind_export() {
    export_words_.clear();
    for (std::uint32_t number = 0; number < tile_batches_.size(); ++number) {
        const TileBatchOnDevice& on_device = tile_batches_[number];
        const OutputParts& parts = on_device.output;
        const VkBuffer buffer = words_of(on_device);
        export_words_.push_back(
            {{buffer, parts.points, parts.field - parts.points},
             {buffer, parts.field, parts.summaries - parts.field},
             {read_back_.handle(), parts.summaries, parts.samples - parts.summaries},
             hits_of(number),
             static_cast<std::uint32_t>(on_device.batch->points.size())});
    }
    resident_.bind(export_words_, {words_.handle(), 0, smallest_part}, read_back_.handle());
}

void BatchResources::empty_output(const TileBatchOnDevice& on_device) const {
    const plan::TileSummary empty;
    const OutputParts& parts = on_device.output;
    std::memset(read_back_.data() + parts.samples, 0, sizeof(std::uint32_t));
    for (std::size_t i = 0; i < on_device.batch->tiles.size(); ++i) {
        std::memcpy(read_back_.data() + parts.summaries + i * sizeof(empty), &empty, sizeof(empty));
    }
}

void BatchResources::bind(std::uint32_t number) const {
    using Layout = passes::ComputeLayout;
    const TileBatchOnDevice& on_device = tile_batches_[number];
    const plan::TileBatch& batch = *on_device.batch;
    const passes::TileBatchSets& sets = sets_[number].sets();
    const InputParts& input = on_device.input;
    const OutputParts& output = on_device.output;
    const GraphKey needs = on_device.graph->needs();
    // Vulkan forbids an empty range; a pass without work reads nothing.
    const auto write = [&](VkDescriptorSet set, Layout::Binding binding, VkBuffer buffer,
                           std::uint64_t from, std::uint64_t to) {
        layout_->write_buffer(set, binding, buffer, from, std::max(to - from, smallest_part));
    };
    const auto write_tiles = [&](VkDescriptorSet set) {
        write(set, Layout::tiles, input_.handle(), input.tiles, input.groups_end);
        write(set, Layout::geometry, input_.handle(), input.geometry,
              input.geometry + bytes_of(batch.lists.geometry()));
    };
    if (needs.points) {
        write_tiles(sets.points);
        write(sets.points, Layout::points, input_.handle(), input.points, input.field_points);
        write(sets.points, Layout::output, words_of(on_device), output.points, output.field);
    }
    const auto write_field = [&](VkDescriptorSet set) {
        write_tiles(set);
        write(set, Layout::points, input_.handle(), input.field_points, input.end);
        write(set, Layout::output, words_of(on_device), output.field, output.summaries);
    };
    for (std::size_t encoding = 0; encoding < plan::sign_encodings; ++encoding) {
        if (needs.field[encoding]) {
            write_field(sets.field[encoding]);
        }
    }
    if (needs.blended) {
        write_field(sets.gradients);
    }
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        if (needs.overlap[i]) {
            write_tiles(sets.samples[i]);
            write(sets.samples[i], Layout::summaries, read_back_.handle(), output.summaries,
                  output.samples);
            write(sets.samples[i], Layout::output, read_back_.handle(), output.samples, output.end);
            if (batch.raster.hit_words > 0) {
                write(sets.samples[i], Layout::kept_hits, words_.handle(), output.hits,
                      output.hits + batch.raster.hit_words * sizeof(std::uint32_t));
            }
        }
    }
    on_device.graph->bind_images(*layout_, sets);
}

void BatchResources::bind_compute(std::uint32_t number) const {
    const TileBatchOnDevice& on_device = tile_batches_[number];
    const OutputParts& parts = on_device.output;
    const VkBuffer words = words_of(on_device);
    const VkBuffer read_back = read_back_.handle();
    compute_[number]->bind(*layout_, sets_[number].sets(),
                           {{words, parts.points, parts.field - parts.points},
                            {words, parts.field, parts.summaries - parts.field},
                            {read_back, parts.summaries, parts.samples - parts.summaries},
                            {read_back, parts.samples, parts.end - parts.samples}});
}

void BatchResources::bind_buffers(CompiledGraph& graph, std::uint32_t number) const {
    const VkBuffer words = words_of(tile_batches_[number]);
    if (tile_batches_[number].batch->by_compute) {
        const ComputeBuffers& compute = *compute_[number];
        graph.set_buffers({.input = compute.input(),
                           .scratch = compute.scratch(),
                           .shapes = compute.shapes(),
                           .crowd = compute.crowd(),
                           .long_searches = compute.long_searches(),
                           .words = words,
                           .read_back = read_back_.handle()});
    } else {
        graph.set_buffers({.mesh = mesh_.handle(),
                           .input = input_.handle(),
                           .words = words,
                           .hits = words_.handle(),
                           .read_back = read_back_.handle()});
    }
}

}  // namespace nearfield::render
