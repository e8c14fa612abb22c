#include <engine/base/unique_numbers.hpp>
#include <engine/graph/access.hpp>
#include <engine/render/host_targets.hpp>
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

/// A part follows the one before, and not the host.
constexpr graph::ExternalUse after_part{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                        VK_ACCESS_SHADER_WRITE_BIT};

/// That a target has room for, within what shaders reach.
template <class Data>
std::uint32_t elements_of(const BufferTarget& target, const gpu::Device& device) {
    const std::uint64_t bytes =
        std::min<std::uint64_t>(target.size, device.limits().maxStorageBufferRange);
    return static_cast<std::uint32_t>(bytes / sizeof(Data));
}

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

void PairOutputs::set(const passes::ExportPairs& passes, const geometry::Vector& origin,
                      const PairTarget* target) {
    if (passes_ != &passes) {
        resources_.clear();
        header_resources_.clear();
    }
    const std::optional<PairTarget> wanted =
        target == nullptr ? std::nullopt : std::optional(*target);
    if (passes_ != &passes || origin != origin_ || wanted != target_) {
        ++revision_;
    }
    passes_ = &passes;
    origin_ = origin;
    target_ = wanted;
}

void PairOutputs::limit(PairTableCounts& room) const {
    if (target_) {
        room.rows = std::min(room.rows, elements_of<PairData>(target_->pairs, *device_));
        room.points = std::min(room.points, elements_of<PointData>(target_->points, *device_));
    }
}

void PairOutputs::reserve(const SearchMemory& search) {
    PairTableCounts room = search.room();
    bool is_new = headers_.reserve(2 * bytes_between_headers) || bound_ != revision_;
    if (target_) {
        room.rows = elements_of<PairData>(target_->pairs, *device_);
        room.points = elements_of<PointData>(target_->points, *device_);
    } else {
        is_new = pairs_.reserve(bytes_of_pairs(room.rows)) || is_new;
        is_new = records_.reserve(bytes_of_records(room.points)) || is_new;
    }
    if (is_new || pair_room_ != room.rows || record_room_ != room.points) {
        handles_ = next_revision();
    }
    pair_room_ = room.rows;
    record_room_ = room.points;
}

template <class Use>
void PairOutputs::for_host_headers(const Use& use) const {
    if (target_ && target_->pairs.header_offset) {
        use(headers_.part(0, sizeof(HeaderData)), target_->pairs);
    }
    if (target_ && target_->points.header_offset) {
        use(headers_.part(bytes_between_headers, sizeof(HeaderData)), target_->points);
    }
}

void PairOutputs::bind(const SearchInput& input, const SearchMemory& search) {
    reserve(search);
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
        const auto set_output = [&](graph::Handle handle, const gpu::MappedBuffer& own,
                                    std::uint64_t bytes, const BufferTarget* target) {
            if (target == nullptr) {
                resources.set(handle, own.part(0, bytes));
                return;
            }
            std::optional<graph::ExternalUses> uses = uses_of(*target);
            if (i > 0) {
                uses->before = after_part;
            }
            resources.set(handle, part_of(*target, target->offset, bytes), uses);
        };
        set_output(passes_->pairs, pairs_, bytes_of_pairs(pair_room_),
                   target_ ? &target_->pairs : nullptr);
        set_output(passes_->records, records_, bytes_of_records(record_room_),
                   target_ ? &target_->points : nullptr);
        resources.set(passes_->headers, headers_.part(0, 2 * bytes_between_headers));
        updates_.add(resources);
    }
    updates_.end();
    const passes::CopyHeader& copy = passes_->copy_header;
    std::size_t headers = 0;
    for_host_headers([&](const gpu::BufferPart& own, const BufferTarget& target) {
        if (headers == header_resources_.size()) {
            header_resources_.push_back(copy.graph.make_resources(*layout_));
        }
        graph::BoundResources& resources = header_resources_[headers++];
        resources.set(copy.header, own);
        resources.set(copy.target, header_part_of(target), uses_of(target));
    });
    bound_ = revision_;
}

void PairOutputs::record(std::size_t part, const passes::PairSearch::Input& input,
                         VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
    passes_->graph.execute(commands, timestamps, resources_[part],
                           {input.push,
                            {{static_cast<float>(origin_.x()), static_cast<float>(origin_.y())},
                             pair_room_,
                             record_room_}});
}

void PairOutputs::record_headers(VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
    std::size_t headers = 0;
    for_host_headers([&](const gpu::BufferPart&, const BufferTarget&) {
        passes_->copy_header.graph.execute(commands, timestamps, header_resources_[headers++], {});
    });
}

std::size_t PairOutputs::count_passes(std::size_t parts) const {
    std::size_t headers = 0;
    for_host_headers([&](const gpu::BufferPart&, const BufferTarget&) { ++headers; });
    return is_set() ? parts * passes_->graph.passes().size() + headers : 0;
}

PairsOnDevice PairOutputs::pairs() const {
    const graph::AccessTraits traits =
        graph::traits(graph::Access::exported_buffer, device_->queue_flags());
    const bool is_exclusive = device_->reader_families().empty();
    PairsOnDevice pairs;
    pairs.pairs = {
        pairs_.handle(), 0, bytes_of_pairs(pair_room_), pair_room_, {headers_.handle(), 0}};
    pairs.points = {records_.handle(),
                    0,
                    bytes_of_records(record_room_),
                    record_room_,
                    {headers_.handle(), bytes_between_headers}};
    const auto move = [](ArrayOnDevice& array, const BufferTarget& target) {
        array.buffer = target.buffer;
        array.offset = target.offset;
        if (target.header_offset) {
            array.header = {target.buffer, *target.header_offset};
        }
    };
    if (target_) {
        move(pairs.pairs, target_->pairs);
        move(pairs.points, target_->points);
    }
    pairs.origin = geometry::to_public(origin_);
    pairs.state = {traits.stages, traits.access(), traits.layout,
                   is_exclusive ? device_->queue_family() : VK_QUEUE_FAMILY_IGNORED};
    pairs.revision = handles_;
    return pairs;
}

}  // namespace nearfield::render
