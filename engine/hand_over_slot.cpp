#include <engine/graph/access.hpp>
#include <engine/hand_over_slot.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace nearfield {
namespace {

using Layout = passes::ComputeLayout;

constexpr std::array<const char*, 1> set_names{"nearfield hand over set"};

std::uint64_t bytes_of_records(const plan::RecordsHandOver& records) {
    return sizeof(SummaryData) + std::uint64_t{records.capacity} * sizeof(RecordData);
}

}  // namespace

HandOverSlot::HandOverSlot(const gpu::Device& device, const passes::ComputeLayout& layout)
    : device_(&device),
      layout_(&layout),
      tables_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
              "nearfield hand over tables"),
      records_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
               gpu::Direction::none, "nearfield resident records") {}

void HandOverSlot::upload(const plan::HandOver& hand_over) {
    hand_over_ = &hand_over;
    for (std::size_t i = 0; i < hand_over.fields.size(); ++i) {
        if (i == images_.size()) {
            const std::string number = std::to_string(i);
            images_.push_back({gpu::KeptImage(*device_, VK_FORMAT_R32_SFLOAT,
                                              "nearfield resident signed distance " + number),
                               gpu::KeptImage(*device_, VK_FORMAT_R32_UINT,
                                              "nearfield resident feature id " + number)});
        }
        const VkExtent2D extent{hand_over.fields[i].width, hand_over.fields[i].height};
        images_[i].signed_distance.reserve(extent);
        images_[i].feature.reserve(extent);
    }
    lay_out_records();
    upload_tables();
    make_sets();
}

void HandOverSlot::lay_out_records() {
    const std::uint64_t step =
        std::max<std::uint64_t>(device_->limits().minStorageBufferOffsetAlignment, smallest_part);
    const auto align = [step](std::uint64_t offset) { return (offset + step - 1) / step * step; };
    places_.clear();
    std::uint64_t end = 0;
    for (const plan::RecordsHandOver& records : hand_over_->records) {
        require_range(*device_, bytes_of_records(records), "the records");
        Place& place = places_.emplace_back();
        place.records = align(end);
        place.blocks = align(place.records + bytes_of_records(records));
        place.end = place.blocks +
                    std::max<std::uint64_t>(records.block_count, 1) * sizeof(plan::RecordBlockData);
        end = place.end;
    }
    if (end > 0) {
        records_.reserve(end);
    }
}

void HandOverSlot::upload_tables() {
    const std::vector<std::uint32_t>& tables = hand_over_->tables;
    require_range(*device_, bytes_of(tables), "the tables of what is handed over");
    tables_.reserve(std::max(bytes_of(tables), smallest_part));
    if (!tables.empty()) {
        std::memcpy(tables_.data(), tables.data(), bytes_of(tables));
    }
    tables_.flush();
}

void HandOverSlot::make_sets() {
    const std::size_t wanted =
        hand_over_->field_parts.size() + hand_over_->point_runs.size() + hand_over_->records.size();
    while (own_sets_.size() < wanted) {
        own_sets_.emplace_back(*device_, *layout_, set_names);
    }
    sets_.clear();
    for (std::size_t i = 0; i < wanted; ++i) {
        sets_.push_back(own_sets_[i][0]);
    }
}

void HandOverSlot::bind_words(VkDescriptorSet set, const BufferPart& words) const {
    layout_->write_buffer(set, Layout::words, words.buffer, words.offset,
                          std::max(words.bytes, smallest_part));
    layout_->write_buffer(set, Layout::tables, tables_.handle(), 0,
                          std::max(bytes_of(hand_over_->tables), smallest_part));
}

void HandOverSlot::bind_records(VkDescriptorSet set, const Place& place) const {
    layout_->write_buffer(set, Layout::records, records_.handle(), place.records,
                          place.blocks - place.records);
    layout_->write_buffer(set, Layout::record_blocks, records_.handle(), place.blocks,
                          place.end - place.blocks);
}

void HandOverSlot::bind(std::span<const Words> words, const BufferPart& none) {
    words_ = none.buffer;
    auto set = sets_.begin();
    for (std::size_t i = 0; i < hand_over_->fields.size(); ++i) {
        const plan::FieldHandOver& field = hand_over_->fields[i];
        for (std::uint32_t part = 0; part < field.part_count; ++part, ++set) {
            const std::uint32_t round = hand_over_->field_parts[field.first_part + part].round;
            bind_words(*set, words[round].field);
            layout_->write_storage_image(*set, Layout::signed_distance_image,
                                         images_[i].signed_distance.view());
            layout_->write_storage_image(*set, Layout::feature_id_image, images_[i].feature.view());
        }
    }
    details_.clear();
    for (std::size_t i = 0; i < hand_over_->records.size(); ++i) {
        const plan::RecordsHandOver& records = hand_over_->records[i];
        for (std::uint32_t number = 0; number < records.run_count; ++number, ++set) {
            const plan::PointRunHandOver& run = hand_over_->point_runs[records.first_run + number];
            bind_words(*set, words[run.round].points);
            bind_records(*set, places_[i]);
            constexpr std::uint32_t words_of_details =
                sizeof(plan::PointDetails) / sizeof(std::uint32_t);
            details_.push_back(words[run.round].point_count + words_of_details * run.first);
        }
        bind_words(*set, none);
        bind_records(*set++, places_[i]);
    }
}

passes::HandOverField::Item HandOverSlot::field_item(std::size_t i) const {
    const plan::FieldHandOver& field = hand_over_->fields[i];
    return {&field,
            std::span(hand_over_->field_parts).subspan(field.first_part, field.part_count),
            std::span(sets_).subspan(field.first_part, field.part_count),
            words_,
            images_[i].signed_distance.handle(),
            images_[i].feature.handle()};
}

passes::HandOverRecords::Item HandOverSlot::records_item(std::size_t i) const {
    const plan::RecordsHandOver& records = hand_over_->records[i];
    const std::size_t first_set = hand_over_->field_parts.size() + records.first_run + i;
    return {&records,
            std::span(hand_over_->point_runs).subspan(records.first_run, records.run_count),
            std::span(details_).subspan(records.first_run, records.run_count),
            std::span(sets_).subspan(first_set, records.run_count + 1),
            words_,
            records_.handle()};
}

HandedOver HandOverSlot::state(graph::Access access) const {
    const graph::AccessTraits& traits = graph::traits(access);
    return {traits.stages, traits.access(), traits.layout, device_->queue_family()};
}

ResidentField HandOverSlot::field(std::size_t i) const {
    const auto image = [](const gpu::KeptImage& kept) {
        return ResidentImage{kept.handle(), kept.view(), kept.format()};
    };
    const plan::FieldHandOver& field = hand_over_->fields[i];
    const Images& images = images_[i];
    return {image(images.signed_distance),
            image(images.feature),
            field.width,
            field.height,
            images.signed_distance.extent(),
            geometry::to_public(field.origin),
            field.cell,
            field.error_bound,
            state(graph::Access::handed_over_image)};
}

ResidentRecords HandOverSlot::records(std::size_t i) const {
    const plan::RecordsHandOver& records = hand_over_->records[i];
    return {records_.handle(),
            places_[i].records,
            bytes_of_records(records),
            records.capacity,
            geometry::to_public(records.origin),
            records.error_bound,
            state(graph::Access::handed_over_buffer)};
}

}  // namespace nearfield
