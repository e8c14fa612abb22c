#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/plan/pair_question.hpp>
#include <engine/render/pair_counts.hpp>
#include <engine/render/pair_parts.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_sets.hpp>
#include <passes/pair_search.hpp>

#include <shaders/pairs.h>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::render {

/// What a part of a search for pairs leaves for the host, and what its passes are recorded from.
/// The memory only grows.
class PairPartMemory {
public:
    PairPartMemory(const gpu::Device& device, const passes::ComputeLayout& layout,
                   const plan::PairQuestion& question);
    PairPartMemory(const PairPartMemory&) = delete;
    PairPartMemory& operator=(const PairPartMemory&) = delete;

    /// What all parts share.
    struct Shared {
        VkDescriptorSet of_instances = VK_NULL_HANDLE;
        VkBuffer shapes = VK_NULL_HANDLE;
        std::uint64_t shape_bytes = 0;
        VkBufferView texels = VK_NULL_HANDLE;
        VkBuffer instances = VK_NULL_HANDLE;
        VkBuffer scratch = VK_NULL_HANDLE;
        std::uint64_t scratch_bytes = 0;
        VkBufferView scratch_texels = VK_NULL_HANDLE;
        VkBuffer arguments = VK_NULL_HANDLE;
    };
    /// Makes room for a part, and places its arrays in the scratch memory of all `instances`.
    void lay_out(const PairPart& part, std::uint32_t instances);
    /// Between updates of the layout begin and end; after that the passes can be recorded.
    void bind(const Shared& shared);
    [[nodiscard]] const passes::PairSearch::Item& item() const { return item_; }
    [[nodiscard]] std::uint64_t row_bytes() const {
        return bytes_of_pair_rows(item_.capacities[plan::row_total]);
    }

    /// Empties the counts, so that a device that is lost leaves none of an earlier search.
    /// `pairs`: in place of the number of pairs until it has counted them.
    void clear_counts(std::uint32_t pairs);
    [[nodiscard]] PairCounts read_counts() const;
    /// Reads what there was room for. `first_row`: how many rows the parts before have.
    void read_results(std::uint32_t first_row, std::vector<std::uint32_t>& undecided);

    /// Of what was read last.
    [[nodiscard]] std::uint32_t first_row() const { return first_row_; }
    [[nodiscard]] std::uint32_t row_count() const { return row_count_; }
    /// Pairs that the search was asked about.
    [[nodiscard]] std::uint32_t candidates() const { return candidates_; }
    [[nodiscard]] const plan::PairRowData& row(std::uint32_t i) const { return rows_data()[i + 1]; }
    /// Only if the host reads them.
    [[nodiscard]] const plan::FoundPointData* records() const {
        return reinterpret_cast<const plan::FoundPointData*>(records_.data());
    }

private:
    [[nodiscard]] const plan::PairRowData* rows_data() const {
        return reinterpret_cast<const plan::PairRowData*>(rows_.data());
    }
    [[nodiscard]] std::uint32_t count(std::uint32_t word) const;

    const passes::ComputeLayout* layout_;
    plan::PairSearchKind kind_;
    gpu::MappedBuffer records_;
    gpu::MappedBuffer rows_;
    gpu::MappedBuffer counts_;
    passes::DescriptorSets sets_;
    passes::PairSearch::Item item_;
    std::uint32_t first_row_ = 0;
    std::uint32_t row_count_ = 0;
    std::uint32_t candidates_ = 0;
};

}  // namespace nearfield::render
