#pragma once

#include <engine/geometry/vector.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <nearfield/pairs_on_device.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_sets.hpp>
#include <passes/export_pairs.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::render {

/// What stays on the device of the search for all pairs of a world, if that is asked for.
class PairOutputs {
public:
    PairOutputs(const gpu::Device& device, const passes::ComputeLayout& layout);

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
        return count * sizeof(RecordData);
    }
    /// Makes room for what a search has room for.
    void reserve(std::uint32_t pairs, std::uint32_t records);

    /// A buffer of the search.
    struct Range {
        VkBuffer buffer = VK_NULL_HANDLE;
        std::uint64_t bytes = 0;
    };
    struct Input {
        Range shapes, instances, scratch;
        VkBufferView texels, scratch_texels;
    };
    /// A part of it, which has to stay.
    struct InputOfPart {
        const passes::PairSearch::Item& search;
        Range rows;
    };
    /// Say for which search the passes are recorded, and then for each of its parts. The device
    /// must not be working at what was recorded before.
    void bind(const Input& input);
    void bind(std::size_t part, const InputOfPart& input);
    void record(std::size_t part, VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
        passes_->record(commands, timestamps, items_[part]);
    }

    [[nodiscard]] PairsOnDevice pairs() const;

private:
    const gpu::Device* device_;
    const passes::ComputeLayout* layout_;
    gpu::MappedBuffer pairs_;
    gpu::MappedBuffer records_;
    gpu::MappedBuffer headers_;
    passes::DescriptorSets set_of_records_;
    std::vector<passes::DescriptorSets> sets_of_rows_;  // by part, as are these
    std::vector<passes::ExportPairs::Item> items_;
    const passes::ExportPairs* passes_ = nullptr;
    Range instances_;
    geometry::Vector origin_ = geometry::Vector::Zero();
    std::uint32_t pair_room_ = 0;
    std::uint32_t record_room_ = 0;
    std::uint32_t revision_ = 0;
    std::uint64_t handles_ = 0;  // changes with them, and is unique in the process
};

}  // namespace nearfield::render
