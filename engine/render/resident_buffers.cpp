#include <engine/base/unique_numbers.hpp>
#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/resident_buffers.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

namespace nearfield::render {
namespace {

using Layout = passes::ComputeLayout;

constexpr std::array<const char*, 1> set_names{"nearfield export set"};

std::uint64_t bytes_of_records(const plan::RecordsOutput& records) {
    return sizeof(SummaryData) + std::uint64_t{records.capacity} * sizeof(RecordData);
}

std::uint64_t bytes_of_samples(const plan::SamplesOutput& samples) {
    return sizeof(IntersectionSummaryData) +
           std::uint64_t{samples.capacity} * sizeof(IntersectionSampleData);
}

/// What has to be reserved for records or samples: nothing where the host has given a buffer.
template <class Output>
std::uint64_t own_bytes(const Output& output, std::uint64_t bytes) {
    return output.target.buffer == VK_NULL_HANDLE ? bytes : 0;
}

std::uint64_t bytes_of_blocks(const plan::RecordsOutput& records) {
    return std::uint64_t{records.block_count} * sizeof(plan::RecordBlockData);
}

std::uint64_t bytes_of_blocks(const plan::SamplesOutput& samples) {
    return (std::uint64_t{samples.tile_count} * plan::words_of_box + samples.block_count) *
           sizeof(std::uint32_t);
}

/// Removes the first `count` of the remaining sets and returns them.
std::span<const VkDescriptorSet> take(std::span<const VkDescriptorSet>& sets, std::size_t count) {
    const std::span<const VkDescriptorSet> taken = sets.first(count);
    sets = sets.subspan(count);
    return taken;
}

}  // namespace

ResidentBuffers::ResidentBuffers(const gpu::Device& device, const passes::ComputeLayout& layout)
    : device_(&device),
      layout_(&layout),
      tables_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
              "nearfield export tables"),
      records_(device,
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                   VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
               gpu::Direction::none, "nearfield resident records", device.resident_families()) {}

void ResidentBuffers::upload(const plan::ResidentOutputs& resident) {
    resident_ = &resident;
    reserve_images();
    find_views();
    lay_out_buffer();
    upload_tables();
    make_sets();
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
        const plan::FieldOutputs& field = resident_->fields[i];
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
    const auto view_of = [](const ResidentImageTarget& target, const gpu::KeptImage& own) {
        return target.image == VK_NULL_HANDLE ? own.view() : target.view;
    };
    views_.clear();
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        const ResidentFieldTarget& target = resident_->fields[i].target;
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
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        grow(field_places_, i, 0, 0);
    }
    for (std::size_t i = 0; i < resident_->records.size(); ++i) {
        const plan::RecordsOutput& records = resident_->records[i];
        require_range(*device_, bytes_of_records(records), "the records");
        grow(places_, i, own_bytes(records, bytes_of_records(records)), bytes_of_blocks(records));
    }
    for (std::size_t i = 0; i < resident_->samples.size(); ++i) {
        const plan::SamplesOutput& samples = resident_->samples[i];
        require_range(*device_, bytes_of_samples(samples), "the samples that stay");
        grow(sample_places_, i, own_bytes(samples, bytes_of_samples(samples)),
             bytes_of_blocks(samples));
    }
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
            each.header = place(sizeof(ResidentHeaderData));
            each.records = place(each.record_bytes);
            each.blocks = place(std::max(each.block_bytes, smallest_part));
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

void ResidentBuffers::make_sets() {
    sets_.clear();
    append_sets(resident_->field_parts.size(), sets_of_images_);
    append_sets(resident_->point_runs.size() + resident_->records.size() +
                    2 * resident_->sample_runs.size() + resident_->samples.size(),
                sets_of_buffers_);
    append_sets(resident_->fields.size() + resident_->records.size() + resident_->samples.size(),
                sets_of_headers_);
}

void ResidentBuffers::append_sets(std::size_t count, std::vector<passes::DescriptorSets>& own) {
    while (own.size() < count) {
        own.emplace_back(*device_, *layout_, set_names);
    }
    for (std::size_t i = 0; i < count; ++i) {
        sets_.push_back(own[i][0]);
    }
}

void ResidentBuffers::bind_words(VkDescriptorSet set, const BufferPart& words) const {
    layout_->write_buffer(set, Layout::words, words.buffer, words.offset,
                          std::max(words.bytes, smallest_part));
    layout_->write_buffer(set, Layout::tables, tables_.handle(), 0,
                          std::max(bytes_of(resident_->tables), smallest_part));
}

BufferPart ResidentBuffers::range_of(std::size_t i, const plan::RecordsOutput& records) const {
    return range_of_target(records.target,
                           {records_.handle(), places_[i].records, bytes_of_records(records)});
}

BufferPart ResidentBuffers::range_of(std::size_t i, const plan::SamplesOutput& samples) const {
    return range_of_target(
        samples.target, {records_.handle(), sample_places_[i].records, bytes_of_samples(samples)});
}

void ResidentBuffers::bind_records(VkDescriptorSet set, const Place& place,
                                   const BufferPart& range) const {
    layout_->write_host_buffer(set, Layout::records, range.buffer, range.offset, range.bytes);
    layout_->write_buffer(set, Layout::record_blocks, records_.handle(), place.blocks,
                          std::max(place.block_bytes, smallest_part));
}

void ResidentBuffers::bind_headers() {
    headers_.clear();
    std::span<const VkDescriptorSet> sets = std::span(sets_).last(
        resident_->fields.size() + resident_->records.size() + resident_->samples.size());
    const auto add = [&](const geometry::Vector& origin, double cell, const Place& place,
                         const BufferPart& summary) -> plan::ExportHeaderPush& {
        const VkDescriptorSet set = take(sets, 1).front();
        layout_->write_buffer(set, Layout::records, summary.buffer, summary.offset, smallest_part);
        layout_->write_buffer(set, Layout::record_blocks, records_.handle(), place.header,
                              sizeof(ResidentHeaderData));
        return headers_.emplace_back(
            plan::ExportHeaderPush{{static_cast<float>(origin.x()), static_cast<float>(origin.y())},
                                   static_cast<float>(cell)});
    };
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        const plan::FieldOutputs& field = resident_->fields[i];
        const BufferPart unread{records_.handle(), field_places_[i].blocks, smallest_part};
        auto& header = add(field.origin, field.cell, field_places_[i], unread);
        header.width = field.width;
        header.height = field.height;
    }
    for (std::size_t i = 0; i < resident_->records.size(); ++i) {
        const plan::RecordsOutput& records = resident_->records[i];
        add(records.origin, records.cell, places_[i], range_of(i, records));
    }
    for (std::size_t i = 0; i < resident_->samples.size(); ++i) {
        const plan::SamplesOutput& samples = resident_->samples[i];
        add(samples.origin, samples.cell, sample_places_[i], range_of(i, samples));
    }
}

void ResidentBuffers::bind(std::span<const Words> words, const BufferPart& none,
                           VkBuffer summaries) {
    words_ = none.buffer;
    summaries_ = summaries;
    std::span<const VkDescriptorSet> sets(sets_);
    bind_fields(words, sets);
    bind_points(words, none, sets);
    bind_samples(words, none, sets);
    bind_headers();
}

void ResidentBuffers::bind_fields(std::span<const Words> words,
                                  std::span<const VkDescriptorSet>& sets) const {
    for (std::size_t i = 0; i < resident_->fields.size(); ++i) {
        const plan::FieldOutputs& field = resident_->fields[i];
        std::uint32_t part = field.first_part;
        for (const VkDescriptorSet set : take(sets, field.part_count)) {
            bind_words(set, words[resident_->field_parts[part++].tile_batch].field);
            layout_->write_storage_image(set, Layout::signed_distance_image,
                                         views_[i].signed_distance);
            layout_->write_storage_image(set, Layout::feature_id_image, views_[i].feature);
        }
    }
}

void ResidentBuffers::bind_points(std::span<const Words> words, const BufferPart& none,
                                  std::span<const VkDescriptorSet>& sets) {
    details_.clear();
    for (std::size_t i = 0; i < resident_->records.size(); ++i) {
        const plan::RecordsOutput& records = resident_->records[i];
        std::uint32_t number = records.first_run;
        for (const VkDescriptorSet set : take(sets, records.run_count)) {
            const plan::PointRunOutput& run = resident_->point_runs[number++];
            bind_words(set, words[run.tile_batch].points);
            bind_records(set, places_[i], range_of(i, records));
            details_.push_back(words[run.tile_batch].point_count +
                               plan::words_of_details * run.first);
        }
        const VkDescriptorSet last = take(sets, 1).front();
        bind_words(last, none);
        bind_records(last, places_[i], range_of(i, records));
    }
}

void ResidentBuffers::bind_samples(std::span<const Words> words, const BufferPart& none,
                                   std::span<const VkDescriptorSet>& sets) const {
    for (std::size_t i = 0; i < resident_->samples.size(); ++i) {
        const plan::SamplesOutput& samples = resident_->samples[i];
        const auto bind = [&](const BufferPart& part) {
            const VkDescriptorSet set = take(sets, 1).front();
            bind_words(set, part);
            bind_records(set, sample_places_[i], range_of(i, samples));
        };
        for (std::uint32_t number = 0; number < samples.run_count; ++number) {
            const Words& batch =
                words[resident_->sample_runs[samples.first_run + number].tile_batch];
            bind(batch.summaries);
            bind(samples.block_count > 0 ? batch.hits : none);
        }
        bind(none);
    }
}

passes::ExportField::Item ResidentBuffers::field_item(std::size_t i) const {
    const plan::FieldOutputs& field = resident_->fields[i];
    return {&field,
            std::span(resident_->field_parts).subspan(field.first_part, field.part_count),
            std::span(sets_).subspan(field.first_part, field.part_count),
            words_,
            imported_image(field.target.signed_distance, images_[i].signed_distance.handle()),
            imported_image(field.target.feature, images_[i].feature.handle())};
}

passes::ExportRecords::Item ResidentBuffers::records_item(std::size_t i) const {
    const plan::RecordsOutput& records = resident_->records[i];
    const std::size_t first_set = resident_->field_parts.size() + records.first_run + i;
    return {&records,
            std::span(resident_->point_runs).subspan(records.first_run, records.run_count),
            std::span(details_).subspan(records.first_run, records.run_count),
            std::span(sets_).subspan(first_set, records.run_count + 1),
            words_,
            records_.handle(),
            imported_buffer(records.target, range_of(i, records))};
}

passes::ExportSamples::Item ResidentBuffers::samples_item(std::size_t i) const {
    const plan::SamplesOutput& samples = resident_->samples[i];
    const std::size_t first_set = resident_->field_parts.size() + resident_->point_runs.size() +
                                  resident_->records.size() + 2 * std::size_t{samples.first_run} +
                                  i;
    return {&samples,
            std::span(resident_->sample_runs).subspan(samples.first_run, samples.run_count),
            resident_->sample_tiles,
            std::span(sets_).subspan(first_set, 2 * std::size_t{samples.run_count} + 1),
            summaries_,
            records_.handle(),
            imported_buffer(samples.target, range_of(i, samples))};
}

passes::ExportHeaders::Item ResidentBuffers::headers_item() const {
    return {headers_, std::span(sets_).last(headers_.size()), records_.handle(),
            readers_of_targets(*resident_)};
}

}  // namespace nearfield::render
