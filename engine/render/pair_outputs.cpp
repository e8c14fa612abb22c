#include <engine/base/unique_numbers.hpp>
#include <engine/graph/access.hpp>
#include <engine/render/pair_outputs.hpp>

#include <shaders/pairs.h>

#include <algorithm>
#include <array>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, 1> name_of_record_set{"nearfield pair set of resident records"};
constexpr std::array<const char*, 1> name_of_row_set{"nearfield pair set of resident rows"};
constexpr VkBufferUsageFlags output_usage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
    VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
constexpr std::uint64_t bytes_between_headers = 4 * std::uint64_t{plan::words_between_headers};
static_assert(sizeof(HeaderData) <= bytes_between_headers);

}  // namespace

PairOutputs::PairOutputs(const gpu::Device& device, const passes::ComputeLayout& layout)
    : device_(&device),
      layout_(&layout),
      pairs_(device, output_usage, gpu::Direction::none, "nearfield resident pairs",
             device.reader_families()),
      records_(device, output_usage, gpu::Direction::none, "nearfield resident pair records",
               device.reader_families()),
      headers_(device, output_usage, gpu::Direction::none, "nearfield resident pair headers",
               device.reader_families()),
      set_of_records_(device, layout, name_of_record_set) {}

void PairOutputs::set(const passes::ExportPairs& passes, const geometry::Vector& origin) {
    if (passes_ != &passes || origin != origin_) {
        ++revision_;
    }
    passes_ = &passes;
    origin_ = origin;
}

void PairOutputs::reserve(std::uint32_t pairs, std::uint32_t records) {
    handles_ = next_revision();
    static_cast<void>(headers_.reserve(2 * bytes_between_headers));
    static_cast<void>(pairs_.reserve(bytes_of_pairs(pairs)));
    static_cast<void>(records_.reserve(bytes_of_records(records)));
    pair_room_ = pairs;
    record_room_ = records;
}

void PairOutputs::bind(const Input& input) {
    using Layout = passes::ComputeLayout;
    instances_ = input.instances;
    const VkDescriptorSet set = set_of_records_[0];
    layout_->begin_updates();
    layout_->write_buffer(set, Layout::tiles, input.shapes.buffer, 0, input.shapes.bytes);
    layout_->write_buffer(set, Layout::geometry, input.scratch.buffer, 0, input.scratch.bytes);
    layout_->write_buffer(set, Layout::output, records_.handle(), 0,
                          bytes_of_records(record_room_));
    layout_->write_texels(set, Layout::texels, input.texels);
    layout_->write_texels(set, Layout::scratch_texels, input.scratch_texels);
    layout_->end_updates();
}

void PairOutputs::bind(std::size_t part, const InputOfPart& input) {
    using Layout = passes::ComputeLayout;
    using passes::ExportPairs;
    if (part >= sets_of_rows_.size()) {
        sets_of_rows_.emplace_back(*device_, *layout_, name_of_row_set);
        items_.emplace_back();
    }
    ExportPairs::Item& item = items_[part];
    item.search = &input.search;
    item.sets[ExportPairs::of_records] = set_of_records_[0];
    item.sets[ExportPairs::of_rows] = sets_of_rows_[part][0];
    item.pairs = pairs_.handle();
    item.records = records_.handle();
    item.headers = headers_.handle();
    item.origin = {static_cast<float>(origin_.x()), static_cast<float>(origin_.y())};
    layout_->begin_updates();
    const auto write = [&](Layout::Binding binding, VkBuffer buffer, std::uint64_t bytes) {
        layout_->write_buffer(item.sets[ExportPairs::of_rows], binding, buffer, 0, bytes);
    };
    write(Layout::tiles, instances_.buffer, instances_.bytes);
    write(Layout::geometry, item.headers, 2 * bytes_between_headers);
    write(Layout::points, input.rows.buffer, input.rows.bytes);
    write(Layout::output, item.pairs, bytes_of_pairs(pair_room_));
    layout_->end_updates();
}

PairsOnDevice PairOutputs::pairs() const {
    const graph::AccessTraits traits =
        graph::traits(graph::Access::exported_buffer, device_->queue_flags());
    const bool is_exclusive = device_->reader_families().empty();
    PairsOnDevice pairs;
    pairs.pairs = {pairs_.handle(), bytes_of_pairs(pair_room_), pair_room_, {headers_.handle(), 0}};
    pairs.records = {records_.handle(),
                     bytes_of_records(record_room_),
                     record_room_,
                     {headers_.handle(), bytes_between_headers}};
    pairs.origin = geometry::to_public(origin_);
    pairs.state = {traits.stages, traits.access(), traits.layout,
                   is_exclusive ? device_->queue_family() : VK_QUEUE_FAMILY_IGNORED};
    pairs.revision = handles_;
    return pairs;
}

}  // namespace nearfield::render
