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
#include <vector>

namespace nearfield::render {

/// What stays on the device of the search for all pairs of a world, if that is asked for.
class PairOutputs {
public:
    PairOutputs(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// From now on searches leave it there. `origin`: of the instances' places.
    void set(const passes::ExportPairs& passes, const geometry::Vector& origin);
    [[nodiscard]] bool is_set() const { return passes_ != nullptr; }
    /// Differs if commands recorded before are about another origin.
    [[nodiscard]] std::uint32_t revision() const { return revision_; }

    /// Bytes of so many rows and records, of one buffer each.
    [[nodiscard]] static std::uint64_t bytes_of_pairs(std::uint64_t count) {
        return count * sizeof(PairData);
    }
    [[nodiscard]] static std::uint64_t bytes_of_records(std::uint64_t count) {
        return count * sizeof(PointData);
    }
    /// Makes room for what a search has room for.
    void reserve(std::uint32_t pairs, std::uint32_t records);

    /// Says for which search the passes are recorded. The device must not be working at what was
    /// recorded before. `input`: what it was laid out with.
    void bind(const SearchInput& input, const SearchMemory& search);
    /// The passes that follow a part. `input`: its own.
    void record(std::size_t part, const passes::PairSearch::Input& input, VkCommandBuffer commands,
                gpu::Timestamps& timestamps) const;
    [[nodiscard]] std::size_t count_passes(std::size_t parts) const;

    [[nodiscard]] PairsOnDevice pairs() const;

private:
    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    gpu::MappedBuffer pairs_;
    gpu::MappedBuffer records_;
    gpu::MappedBuffer headers_;
    graph::DescriptorUpdates updates_;
    const passes::ExportPairs* passes_ = nullptr;
    std::vector<graph::BoundResources> resources_;  // by part
    geometry::Vector origin_ = geometry::Vector::Zero();
    std::uint32_t pair_room_ = 0;
    std::uint32_t record_room_ = 0;
    std::uint32_t revision_ = 0;
    std::uint64_t handles_ = 0;  // changes with them, and is unique in the process
};

}  // namespace nearfield::render
