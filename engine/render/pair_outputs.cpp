#include <engine/base/unique_numbers.hpp>
#include <engine/graph/access.hpp>
#include <engine/render/pair_outputs.hpp>

#include <shaders/pairs.h>

#include <algorithm>
#include <array>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, passes::ExportPairs::set_count> names_of_output_sets{
    "nearfield pair set of resident rows", "nearfield pair set of resident records"};
constexpr VkBufferUsageFlags output_usage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
    VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
constexpr std::uint64_t bytes_between_headers = 4 * std::uint64_t{plan::words_between_headers};
static_assert(sizeof(ResidentHeaderData) <= bytes_between_headers);

}  // namespace

PairOutputs::PairOutputs(const gpu::Device& device, const passes::ComputeLayout& layout)
    : device_(&device),
      layout_(&layout),
      pairs_(device, output_usage, gpu::Direction::none, "nearfield resident pairs",
             device.resident_families()),
      records_(device, output_usage, gpu::Direction::none, "nearfield resident pair records",
               device.resident_families()),
      headers_(device, output_usage, gpu::Direction::none, "nearfield resident pair headers",
               device.resident_families()),
      sets_(device, layout, names_of_output_sets) {
    for (std::size_t i = 0; i < item_.sets.size(); ++i) {
        item_.sets[i] = sets_[i];
    }
}

void PairOutputs::set(const passes::ExportPairs& passes, const geometry::Vector& origin) {
    if (passes_ != &passes || origin != origin_) {
        ++revision_;
    }
    passes_ = &passes;
    origin_ = origin;
    item_.origin = {static_cast<float>(origin.x()), static_cast<float>(origin.y())};
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
    using passes::ExportPairs;
    item_.search = &input.search;
    item_.pairs = pairs_.handle();
    item_.records = records_.handle();
    item_.headers = headers_.handle();
    layout_->begin_updates();
    const auto write = [&](ExportPairs::Set set, Layout::Binding binding, const Part& part) {
        layout_->write_buffer(item_.sets[set], binding, part.buffer, 0, part.bytes);
    };
    write(ExportPairs::of_rows, Layout::tiles, input.instances);
    write(ExportPairs::of_rows, Layout::geometry, {item_.headers, 2 * bytes_between_headers});
    write(ExportPairs::of_rows, Layout::points, input.rows);
    write(ExportPairs::of_rows, Layout::output, {item_.pairs, bytes_of_pairs(pair_room_)});
    write(ExportPairs::of_records, Layout::tiles, input.shapes);
    write(ExportPairs::of_records, Layout::geometry, input.scratch);
    write(ExportPairs::of_records, Layout::output, {item_.records, bytes_of_records(record_room_)});
    layout_->write_texels(item_.sets[ExportPairs::of_records], Layout::texels, input.texels);
    layout_->write_texels(item_.sets[ExportPairs::of_records], Layout::scratch_texels,
                          input.scratch_texels);
    layout_->end_updates();
}

ResidentPairs PairOutputs::pairs() const {
    const graph::AccessTraits traits =
        graph::traits(graph::Access::exported_buffer, device_->queue_flags());
    const bool is_exclusive = device_->resident_families().empty();
    ResidentPairs pairs;
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
