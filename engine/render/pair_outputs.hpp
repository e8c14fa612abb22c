#pragma once

#include <engine/geometry/vector.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/render/search_memory.hpp>
#include <nearfield/pairs_on_device.hpp>
#include <passes/export_pairs.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::render {

/// What stays on the device of the search for all pairs of a world, if that is asked for.
class PairOutputs {
public:
    PairOutputs(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// From now on searches leave it there. `origin`: of the instances' places; `target`: of the
    /// host; null: what stays goes to buffers of nearfield's own.
    void set(const passes::ExportPairs& passes, const geometry::Vector& origin,
             const PairTarget* target);
    [[nodiscard]] bool is_set() const { return passes_ != nullptr; }
    /// Differs if commands recorded before are about another origin or target.
    [[nodiscard]] std::uint32_t revision() const { return revision_; }

    /// Bytes of so many rows and records, of one buffer each.
    [[nodiscard]] static std::uint64_t bytes_of_pairs(std::uint64_t count) {
        return count * sizeof(PairData);
    }
    [[nodiscard]] static std::uint64_t bytes_of_records(std::uint64_t count) {
        return count * sizeof(PointData);
    }

    /// Says for which search the passes are recorded, and makes room for what it has room for. The
    /// device must not be working at what was recorded before. `input`: what it was laid out with.
    void bind(const SearchInput& input, const SearchMemory& search);
    /// The passes that follow a part. `input`: its own.
    void record(std::size_t part, const passes::PairSearch::Input& input, VkCommandBuffer commands,
                gpu::Timestamps& timestamps) const;
    /// The passes that follow all parts.
    void record_headers(VkCommandBuffer commands, gpu::Timestamps& timestamps) const;
    [[nodiscard]] std::size_t count_passes(std::size_t parts) const;

    /// At most what the host's buffers have room for.
    void limit(PairTableCounts& room) const;
    [[nodiscard]] PairsOnDevice pairs() const;

private:
    void reserve(const SearchMemory& search);
    /// Where the headers lie that the host has a place for, and that place.
    template <class Use>
    void for_host_headers(const Use& use) const;

    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    gpu::MappedBuffer pairs_;
    gpu::MappedBuffer records_;
    gpu::MappedBuffer headers_;
    graph::DescriptorUpdates updates_;
    const passes::ExportPairs* passes_ = nullptr;
    std::optional<PairTarget> target_;
    std::vector<graph::BoundResources> resources_;         // by part
    std::vector<graph::BoundResources> header_resources_;  // of headers of the host
    geometry::Vector origin_ = geometry::Vector::Zero();
    std::uint32_t pair_room_ = 0;
    std::uint32_t record_room_ = 0;
    std::uint32_t revision_ = 0;
    std::uint32_t bound_ = 0;    // revision that the handles are of
    std::uint64_t handles_ = 0;  // changes with them, and is unique in the process
};

}  // namespace nearfield::render
