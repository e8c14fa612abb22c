#include <engine/base/unique_numbers.hpp>
#include <engine/gpu/buffer_parts.hpp>
#include <engine/graph/access.hpp>
#include <engine/render/host_targets.hpp>
#include <engine/render/resident_buffers.hpp>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

namespace nearfield::render {
namespace {

static_assert(sizeof(HeaderData) <= shaders::bytes_of_header);

/// Makes sure that there are so many resources of a graph.
template <class Graph>
void reserve(std::vector<graph::BoundResources>& bound, std::size_t count, const Graph& graph,
             const graph::ComputeLayout& layout) {
    while (bound.size() < count) {
        bound.push_back(graph.make_resources(layout));
    }
}

/// An image for the render graph: the host's, or else the library's own. `view`: of either;
/// `identity`: of the library's. Another image or buffer of the host's may have the handle of one
/// that is gone, so each time counts as new.
graph::ImportedImage imported_image(const ImageTarget& target, VkImage own, VkImageView view,
                                    std::uint64_t identity) {
    if (target.image == VK_NULL_HANDLE) {
        return {.image = own, .view = view, .identity = identity};
    }
    return {target.image, target.level,
            target.layer, graph::ExternalUses{use_of(target.before), use_of(target.after)},
            view,         next_revision()};
}

/// Where records or samples lie: in the host's buffer, or else in `own`.
gpu::BufferPart range_of_target(const BufferTarget& target, const gpu::BufferPart& own) {
    return target.buffer == VK_NULL_HANDLE ? own : part_of(target, target.offset, own.bytes);
}

}  // namespace

ResidentBuffers::ResidentBuffers(const gpu::Device& device, const graph::ComputeLayout& layout)
    : device_(&device),
      layout_(&layout),
      tables_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
              "nearfield export tables"),
      records_(device,
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                   VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
               gpu::Direction::none, "nearfield resident records", device.reader_families()) {}

void ResidentBuffers::upload(const device_input::ResidentOutputs& resident,
                             const ExportPipelines& passes) {
    resident_ = &resident;
    reserve_images();
    find_views();
    lay_out_buffer();
    upload_tables();
    make_resources(passes);
}

void ResidentBuffers::reserve_images() {
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        if (i == images_.size()) {
            const std::string number = std::to_string(i);
            images_.push_back({gpu::KeptImage(*device_, VK_FORMAT_R32_SFLOAT,
                                              "nearfield resident signed distance " + number),
                               gpu::KeptImage(*device_, VK_FORMAT_R32_UINT,
                                              "nearfield resident feature id " + number)});
        }
        const device_input::FieldOutputs& field = resident_->fields[i];
        const VkExtent2D extent{field.width, field.height};
        // Of a field without features, an image that nothing is written to.
        const VkExtent2D of_features = field.has_features ? extent : VkExtent2D{1, 1};
        // One after the other: where the second is refused, the first is another one already.
        if (field.target.signed_distance.image == VK_NULL_HANDLE &&
            images_[i].signed_distance.reserve(extent)) {
            revision_ = next_revision();
        }
        if (field.target.feature.image == VK_NULL_HANDLE &&
            images_[i].feature.reserve(of_features)) {
            revision_ = next_revision();
        }
    }
}

void ResidentBuffers::find_views() {
    const auto view_of = [](const ImageTarget& target, const gpu::KeptImage& own) {
        return target.image == VK_NULL_HANDLE ? own.view() : target.view;
    };
    views_.clear();
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        const FieldTarget& target = resident_->fields[i].target;
        views_.push_back({view_of(target.signed_distance, images_[i].signed_distance),
                          view_of(target.feature, images_[i].feature)});
    }
}

void ResidentBuffers::grow(std::vector<Place>& places, std::size_t i, std::uint64_t records,
                           std::uint64_t blocks) {
    if (i == places.size()) {
        places.emplace_back();
        are_laid_out_ = false;
    }
    Place& place = places[i];
    if (records > place.record_bytes || blocks > place.block_bytes) {
        // Half as much again: the number of points varies from frame to frame.
        place.record_bytes = std::max(place.record_bytes, records + records / 2);
        place.block_bytes = std::max(place.block_bytes, blocks + blocks / 2);
        are_laid_out_ = false;
    }
}

void ResidentBuffers::lay_out_buffer() {
    const auto grow_all = [this](const auto& outputs, const char* what,
                                 std::vector<Place>& places) {
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            const device_input::BufferOutput& output = outputs[i];
            require_range(*device_, output.bytes, what);
            // Nothing where the host has given a buffer.
            grow(places, i, output.target.buffer == VK_NULL_HANDLE ? output.bytes : 0,
                 output.block_bytes);
        }
    };
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        grow(field_places_, i, 0, 0);
    }
    grow_all(resident_->records, "the records", places_);
    grow_all(resident_->samples, "the samples that stay", sample_places_);
    if (!are_laid_out_) {
        move_places();
    }
}

/// Lays out all places anew.
void ResidentBuffers::move_places() {
    const std::uint64_t step =
        std::max<std::uint64_t>(device_->limits().minStorageBufferOffsetAlignment, smallest_part);
    std::uint64_t end = 0;
    const auto place = [&end, step](std::uint64_t bytes) {
        return std::exchange(end, (end + bytes + step - 1) / step * step);
    };
    for (std::vector<Place>* const places : {&field_places_, &places_, &sample_places_}) {
        for (Place& each : *places) {
            each.records = place(each.record_bytes);
            each.header = place(shaders::bytes_of_header + each.block_bytes);
        }
    }
    records_.reserve(end);
    revision_ = next_revision();
    are_laid_out_ = true;
}

void ResidentBuffers::upload_tables() {
    const std::vector<std::uint32_t>& tables = resident_->tables;
    require_range(*device_, bytes_of(tables), "the tables of the resident outputs");
    tables_.reserve(std::max(bytes_of(tables), smallest_part));
    if (!tables.empty()) {
        std::memcpy(tables_.data(), tables.data(), bytes_of(tables));
    }
    tables_.flush();
}

void ResidentBuffers::make_resources(const ExportPipelines& passes) {
    const std::size_t fields = resident_->fields.size();
    const std::size_t samples = resident_->samples.size();
    bound_fields_.resize(std::max(bound_fields_.size(), fields));
    for (std::size_t i = 0; i < fields; ++i) {
        reserve(bound_fields_[i], resident_->fields[i].part_count, passes.field.graph, *layout_);
    }
    reserve(bound_records_, resident_->record_runs.size(), passes.records.graph, *layout_);
    std::size_t headers = 0;
    for_host_headers([&](const BufferTarget&, const Place&) { ++headers; });
    reserve(bound_headers_, headers, passes.copy_header.graph, *layout_);
    bound_samples_.resize(std::max(bound_samples_.size(), samples));
    for (std::size_t i = 0; i < samples; ++i) {
        reserve(bound_samples_[i], std::max(resident_->samples[i].run_count, 1U),
                passes.samples.graph, *layout_);
    }
}

gpu::BufferPart ResidentBuffers::range_of(const Place& place,
                                          const device_input::BufferOutput& output) const {
    gpu::BufferPart own = records_.part(place.records, output.bytes);
    own.bytes = output.bytes;
    return range_of_target(output.target, own);
}

void ResidentBuffers::bind(std::span<const Words> words, const gpu::BufferPart& none,
                           const ExportPipelines& passes, graph::DescriptorUpdates& updates) {
    bind_fields(words, passes.field, updates);
    bind_samples(words, none, passes.samples, updates);
    std::size_t bound = 0;
    for_host_headers([&](const BufferTarget& target, const Place& place) {
        graph::BoundResources& resources = bound_headers_[bound++];
        resources.set(passes.copy_header.header, header_part(place));
        resources.set(passes.copy_header.target, header_part_of(target), uses_of(target));
    });
}

template <class Use>
void ResidentBuffers::for_host_headers(const Use& use) const {
    const auto use_those = [&](const auto& outputs, const std::vector<Place>& places) {
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            if (outputs[i].target.header_offset) {
                use(outputs[i].target, places[i]);
            }
        }
    };
    use_those(resident_->records, places_);
    use_those(resident_->samples, sample_places_);
}

void ResidentBuffers::bind_fields(std::span<const Words> words, const passes::ExportField& pass,
                                  graph::DescriptorUpdates& updates) {
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        const device_input::FieldOutputs& field = resident_->fields[i];
        for (std::uint32_t part = 0; part < field.part_count; ++part) {
            const auto& output = resident_->field_parts[field.first_part + part];
            graph::BoundResources& resources = bound_fields_[i][part];
            resources.set(pass.words, words[output.tile_batch].field);
            resources.set(pass.tables, tables());
            resources.set(
                pass.signed_distance,
                imported_image(field.target.signed_distance, images_[i].signed_distance.handle(),
                               views_[i].signed_distance, revision_));
            resources.set(pass.feature,
                          imported_image(field.target.feature, images_[i].feature.handle(),
                                         views_[i].feature, revision_));
            resources.set(pass.header, header_part(field_places_[i]));
            updates.add(resources);
        }
    }
}

void ResidentBuffers::bind_records(const gpu::BufferPart& shapes, const gpu::BufferPart& scratch,
                                   const passes::ExportRecords& passes,
                                   graph::DescriptorUpdates& updates) {
    for (std::size_t i = 0; i < resident_->records.size(); ++i) {
        const device_input::BufferOutput& records = resident_->records[i];
        const gpu::BufferPart range = range_of(places_[i], records);
        std::optional<graph::ExternalUses> uses = uses_of(records.target);
        for (std::uint32_t run = 0; run < records.run_count; ++run) {
            graph::BoundResources& resources = bound_records_[records.first_run + run];
            resources.set(passes.shapes, shapes);
            resources.set(passes.scratch, scratch);
            resources.set(passes.header, header_part(places_[i]));
            resources.set(passes.records, range, uses);
            updates.add(resources);
            if (uses) {
                // The other direction follows this one, and not the host.
                uses->before = {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT};
            }
        }
    }
}

void ResidentBuffers::bind_samples(std::span<const Words> words, const gpu::BufferPart& none,
                                   const passes::ExportSamples& passes,
                                   graph::DescriptorUpdates& updates) {
    for (std::size_t i = 0; i < resident_->samples.size(); ++i) {
        const device_input::SamplesOutput& samples = resident_->samples[i];
        const gpu::BufferPart range = range_of(sample_places_[i], samples);
        const auto bind = [&](std::uint32_t run, const gpu::BufferPart& summaries,
                              const gpu::BufferPart& masks) {
            graph::BoundResources& resources = bound_samples_[i][run];
            resources.set(passes.summaries, summaries);
            resources.set(passes.masks, samples.block_count > 0 ? masks : none);
            resources.set(passes.tables, tables());
            resources.set(passes.header, header_part(sample_places_[i]));
            resources.set(passes.samples, range, uses_of(samples.target));
            updates.add(resources);
        };
        for (std::uint32_t run = 0; run < samples.run_count; ++run) {
            const Words& of = words[resident_->sample_runs[samples.first_run + run].tile_batch];
            bind(run, of.summaries, of.masks);
        }
        if (samples.run_count == 0) {
            bind(0, none, none);
        }
    }
}

std::size_t ResidentBuffers::count_passes(const ExportPipelines& passes) const {
    std::size_t headers = 0;
    for_host_headers([&](const BufferTarget&, const Place&) { ++headers; });
    return headers * passes.copy_header.graph.passes().size() +
           resident_->fields.size() * passes.field.graph.passes().size() +
           resident_->record_runs.size() * passes.records.graph.passes().size() +
           resident_->samples.size() * passes.samples.graph.passes().size();
}

void ResidentBuffers::record_records(const shaders::SearchPush& part,
                                     const passes::ExportRecords& passes, VkCommandBuffer commands,
                                     gpu::Timestamps& timestamps) const {
    for (const device_input::BufferOutput& records : resident_->records) {
        for (std::uint32_t i = records.first_run; i < records.first_run + records.run_count; ++i) {
            const device_input::RecordRunOutput& run = resident_->record_runs[i];
            if (run.direction < part.first_instance || run.direction >= part.end_instance) {
                continue;
            }
            passes::ExportRecords::Input input{part, run.blocks};
            input.push.first = run.direction - part.first_instance;
            input.push.flags = run.flags;
            input.push.capacity = records.capacity;
            input.push.frame_axis = run.frame_axis;
            input.push.frame_place = run.frame_place;
            input.push.origin = device_input::rounded(records.origin);
            input.push.cell = static_cast<float>(records.cell);
            passes.graph.execute(commands, timestamps, bound_records_[i], input);
        }
    }
}

void ResidentBuffers::record(const ExportPipelines& passes, VkCommandBuffer commands,
                             gpu::Timestamps& timestamps) const {
    const auto execute = [&](const auto& graph, const auto& input) {
        graph.execute(commands, timestamps, input.resources.front(), input);
    };
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        const device_input::FieldOutputs& field = resident_->fields[i];
        execute(passes.field.graph,
                passes::ExportField::Input{
                    std::span(resident_->field_parts).subspan(field.first_part, field.part_count),
                    bound_fields_[i]});
    }
    for (std::size_t i = 0; i < resident_->samples.size(); ++i) {
        const device_input::SamplesOutput& samples = resident_->samples[i];
        execute(passes.samples.graph,
                passes::ExportSamples::Input{
                    &samples,
                    std::span(resident_->sample_runs).subspan(samples.first_run, samples.run_count),
                    resident_->sample_tiles, bound_samples_[i]});
    }
    std::size_t bound = 0;
    for_host_headers([&](const BufferTarget&, const Place&) {
        passes.copy_header.graph.execute(commands, timestamps, bound_headers_[bound++], {});
    });
}

OutputState ResidentBuffers::state(graph::Access access) const {
    const graph::AccessTraits traits = graph::traits(access, device_->queue_flags());
    const bool exclusive = device_->reader_families().empty();
    return {traits.stages, traits.access(), traits.layout,
            exclusive ? device_->queue_family() : VK_QUEUE_FAMILY_IGNORED};
}

OutputState ResidentBuffers::state(const BufferTarget& target) const {
    return target.buffer == VK_NULL_HANDLE
               ? state(graph::Access::exported_buffer)
               : OutputState{target.after.stages, target.after.access, VK_IMAGE_LAYOUT_UNDEFINED,
                             device_->queue_family()};
}

FieldOnDevice ResidentBuffers::field(std::size_t i) const {
    const device_input::FieldOutputs& field = resident_->fields[i];
    const Images& images = images_[i];
    VkExtent2D extent{};
    const auto image = [&](const ImageTarget& target, const gpu::KeptImage& kept,
                           VkImageView view) {
        if (target.image != VK_NULL_HANDLE) {
            return ImageOnDevice{target.image, view, target.format};
        }
        extent = kept.extent();
        return ImageOnDevice{kept.handle(), view, kept.format()};
    };
    const ImageOnDevice signed_distance =
        image(field.target.signed_distance, images.signed_distance, views_[i].signed_distance);
    ImageOnDevice feature;
    if (field.has_features) {
        feature = image(field.target.feature, images.feature, views_[i].feature);
    }
    return {signed_distance,
            feature,
            field.width,
            field.height,
            extent,
            geometry::to_public(field.origin),
            field.cell,
            field.error_bound,
            state(graph::Access::exported_image),
            header_at(field_places_[i]),
            slot()};
}

PointsOnDevice ResidentBuffers::records(std::size_t i) const {
    const device_input::BufferOutput& records = resident_->records[i];
    const gpu::BufferPart range = range_of(places_[i], records);
    return {range.buffer,
            range.offset,
            range.bytes,
            records.capacity,
            geometry::to_public(records.origin),
            records.error_bound,
            state(records.target),
            header_at(places_[i], records.target),
            slot()};
}

SamplesOnDevice ResidentBuffers::samples(std::size_t i) const {
    const device_input::SamplesOutput& samples = resident_->samples[i];
    const gpu::BufferPart range = range_of(sample_places_[i], samples);
    return {range.buffer,
            range.offset,
            range.bytes,
            samples.capacity,
            geometry::to_public(samples.origin),
            samples.cell,
            samples.error_bound,
            state(samples.target),
            header_at(sample_places_[i], samples.target),
            slot()};
}

}  // namespace nearfield::render
