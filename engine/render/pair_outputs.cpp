#include <engine/base/unique_numbers.hpp>
#include <engine/graph/access.hpp>
#include <engine/render/pair_outputs.hpp>

#include <shaders/pairs.h>

#include <algorithm>

namespace nearfield::render {
namespace {

constexpr VkBufferUsageFlags output_usage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
    VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
constexpr std::uint64_t bytes_between_headers = 4 * std::uint64_t{shaders::words_between_headers};
static_assert(sizeof(HeaderData) <= bytes_between_headers);

}  // namespace

PairOutputs::PairOutputs(const gpu::Device& device, const graph::ComputeLayout& layout)
    : device_(&device),
      layout_(&layout),
      pairs_(device, output_usage, gpu::Direction::none, "nearfield resident pairs",
             device.reader_families()),
      records_(device, output_usage, gpu::Direction::none, "nearfield resident pair records",
               device.reader_families()),
      headers_(device, output_usage, gpu::Direction::none, "nearfield resident pair headers",
               device.reader_families()),
      updates_(device) {}

void PairOutputs::set(const passes::ExportPairs& passes, const geometry::Vector& origin) {
    if (passes_ != &passes) {
        resources_.clear();
    }
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

void PairOutputs::bind(const SearchInput& input, const SearchMemory& search) {
    while (resources_.size() < search.parts()) {
        resources_.push_back(passes_->graph.make_resources(*layout_));
    }
    updates_.begin();
    for (std::size_t i = 0; i < search.parts(); ++i) {
        graph::BoundResources& resources = resources_[i];
        resources.set(passes_->shapes, input.shapes);
        resources.set(passes_->instances, input.instances);
        resources.set(passes_->scratch, search.scratch());
        resources.set(passes_->arguments, search.arguments());
        resources.set(passes_->rows, search.part(i).row_part());
        resources.set(passes_->pairs, pairs_.part(0, bytes_of_pairs(pair_room_)));
        resources.set(passes_->records, records_.part(0, bytes_of_records(record_room_)));
        resources.set(passes_->headers, headers_.part(0, 2 * bytes_between_headers));
        updates_.add(resources);
    }
    updates_.end();
}

void PairOutputs::record(std::size_t part, const passes::PairSearch::Input& input,
                         VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
    passes_->graph.execute(
        commands, timestamps, resources_[part],
        {input.push, {static_cast<float>(origin_.x()), static_cast<float>(origin_.y())}});
}

std::size_t PairOutputs::count_passes(std::size_t parts) const {
    return is_set() ? parts * passes_->graph.passes().size() : 0;
}

PairsOnDevice PairOutputs::pairs() const {
    const graph::AccessTraits traits =
        graph::traits(graph::Access::exported_buffer, device_->queue_flags());
    const bool is_exclusive = device_->reader_families().empty();
    PairsOnDevice pairs;
    pairs.pairs = {pairs_.handle(), bytes_of_pairs(pair_room_), pair_room_, {headers_.handle(), 0}};
    pairs.points = {records_.handle(),
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
