#pragma once

#include <engine/device_input/search_shapes.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/render/search_parts.hpp>
#include <passes/pair_search.hpp>

#include <shaders/pairs.h>
#include <shaders/push.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::render {

/// In place of the number of pairs until the device has counted them.
inline constexpr std::uint32_t not_counted = UINT32_MAX;

/// The arrays in the scratch memory of a search, one after the other.
class ScratchLayout {
public:
    /// Each adds an array and returns where it starts: in words, or in units of four words.
    [[nodiscard]] std::uint32_t words(std::uint64_t count);
    [[nodiscard]] std::uint32_t units(std::uint64_t count) { return words(4 * count) / 4; }
    /// The sums of the blocks of so many elements, in words.
    [[nodiscard]] std::uint32_t sums(std::uint64_t elements);
    /// Adds the arrays of items, edges and points, and one for the sums of the blocks of any of
    /// these, or of so many other elements.
    void add_stages(std::uint64_t items, std::uint64_t edges, std::uint64_t points,
                    std::uint64_t others, shaders::SearchPush& push);

    [[nodiscard]] std::uint64_t bytes() const { return words_ * sizeof(std::uint32_t); }

private:
    std::uint64_t words_ = shaders::words_of_totals;
};

/// Of a scratch memory, which shaders also read as texels.
inline constexpr VkBufferUsageFlags scratch_usage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

/// The shapes of searches on the device. The memory only grows.
class ShapeBuffer {
public:
    explicit ShapeBuffer(const gpu::Device& device);

    /// Takes shapes that have changed to the device. Returns whether buffer or size are others than
    /// before.
    bool upload(const device_input::SearchShapes& shapes);

    /// What passes bind.
    [[nodiscard]] gpu::BufferPart part() const { return buffer_.part(0, bytes_); }

private:
    gpu::MappedBuffer buffer_;
    std::uint64_t bytes_ = 0;
    std::uint64_t revision_ = 0;  // of the shapes
};

/// What a search reads: shapes, and the instances of a world or the pairs that a batch gives.
struct SearchInput {
    gpu::BufferPart shapes;
    gpu::BufferPart instances;
    std::uint32_t instance_count = 0;  ///< 0: the pairs are given
};

/// What a part of a search leaves for the host, and what its passes are recorded from. The memory
/// only grows.
class PairPartMemory {
public:
    PairPartMemory(const gpu::Device& device, const graph::ComputeLayout& layout,
                   const passes::PairSearch& search, const device_input::PairSearchKind& kind,
                   bool is_resident);
    PairPartMemory(const PairPartMemory&) = delete;
    PairPartMemory& operator=(const PairPartMemory&) = delete;

    [[nodiscard]] const passes::PairSearch::Input& input() const { return input_; }
    /// What the passes after the search bind.
    [[nodiscard]] gpu::BufferPart row_part() const {
        return rows_.part(0, bytes_of_pair_rows(input_.capacities[shaders::row_total]));
    }

    /// Of what was read last: how many rows the parts before have, and this one.
    [[nodiscard]] std::uint32_t first_row() const { return first_row_; }
    [[nodiscard]] std::uint32_t row_count() const { return row_count_; }
    /// Pairs that the search was asked about.
    [[nodiscard]] std::uint32_t candidates() const { return candidates_; }
    [[nodiscard]] const shaders::PairRowData& row(std::uint32_t i) const {
        return rows_data()[i + 1];
    }
    /// In ascending order of the pairs.
    [[nodiscard]] std::span<const shaders::PairRowData> rows() const {
        return {rows_data() + 1, row_count_};
    }
    /// Only if the host reads them; where it does not read all, those that rows ask for.
    [[nodiscard]] const shaders::FoundPointData* records() const {
        return reinterpret_cast<const shaders::FoundPointData*>(records_.data());
    }

private:
    friend class SearchMemory;

    void lay_out(const PairPart& part, std::uint32_t instances);
    void bind(const SearchInput& input, const gpu::BufferPart& scratch,
              const gpu::BufferPart& arguments, graph::DescriptorUpdates& updates);
    void clear_counts(std::uint32_t pairs);
    [[nodiscard]] PairCounts read_counts() const;
    void read_results(std::uint32_t first_row, std::vector<std::uint32_t>& undecided);
    [[nodiscard]] const shaders::PairRowData* rows_data() const {
        return reinterpret_cast<const shaders::PairRowData*>(rows_.data());
    }
    [[nodiscard]] std::uint32_t count(std::uint32_t word) const;

    const passes::PairSearch* search_;
    device_input::PairSearchKind kind_;
    gpu::MappedBuffer records_;
    gpu::MappedBuffer rows_;
    gpu::MappedBuffer counts_;
    graph::BoundResources resources_;
    passes::PairSearch::Input input_;
    std::uint32_t first_row_ = 0;
    std::uint32_t row_count_ = 0;
    std::uint32_t candidates_ = 0;
};

/// The memory of a search between pairs, found or given. It only grows.
/// Where not all pairs fit at once, parts of them are searched one after the other, within the same
/// commands.
class SearchMemory {
public:
    /// The passes must stay.
    SearchMemory(const gpu::Device& device, const graph::ComputeLayout& layout,
                 const passes::PairSearch& search, const device_input::PairSearchKind& kind,
                 const PairTableCounts& reserve, bool is_resident);

    /// The capacities; once they have changed, lay_out() has to follow.
    [[nodiscard]] PairParts& capacities() { return parts_; }
    /// Makes room for them. The device must not be using the memory. Throws StatusException
    /// (too_large) as PairParts::fit().
    void lay_out(const SearchInput& input, const PairLimits& limits);
    [[nodiscard]] std::size_t parts() const { return memories_.size(); }
    [[nodiscard]] const PairPartMemory& part(std::size_t i) const { return *memories_[i]; }
    /// What the passes after the search bind.
    [[nodiscard]] gpu::BufferPart scratch() const { return scratch_.part(0, scratch_bytes_); }
    [[nodiscard]] gpu::BufferPart arguments() const;

    /// Record passes, once laid out: those before the parts, and those of a part.
    void record_boxes(VkCommandBuffer commands, gpu::Timestamps& timestamps) const;
    void record(std::size_t part, VkCommandBuffer commands, gpu::Timestamps& timestamps) const;
    [[nodiscard]] std::size_t count_passes() const;

    /// Empties the counts, so that a device that is lost leaves none of an earlier search. Before
    /// each submission. `pairs`: in place of the number of pairs until the device has counted them.
    void clear_counts(std::uint32_t pairs = 0);
    /// Reads how much was counted, once the device is done.
    void read_counts();
    /// By part, as they were read last.
    [[nodiscard]] std::span<const PairCounts> counts() const { return counts_; }
    /// Whether there was room for `headroom` times as much.
    [[nodiscard]] bool had_room(double headroom = 1.0) const;
    /// What the device has counted last, of all parts; zeros if it has not executed one of them.
    [[nodiscard]] PairTableCounts found() const;
    /// The same of what was read last.
    [[nodiscard]] PairTableCounts last_found() const;
    /// What there is room for, of all parts.
    [[nodiscard]] PairTableCounts room() const;
    /// Throws StatusException (overflow) without.
    void require_room() const;
    /// Reads what there was room for.
    void read_results();
    /// Makes room for what was counted, see grown(); lay_out() has to follow. Throws
    /// StatusException (too_large) if one instance has too many pairs.
    void grow(double headroom = 1.0);

    /// Of the last search: the pairs that it was about, and those that have rows.
    [[nodiscard]] std::uint32_t candidates() const;
    [[nodiscard]] std::uint32_t row_count() const;
    [[nodiscard]] const PairPartMemory& part_of_row(std::uint32_t row) const;
    /// The rows of found pairs that the CPU has to decide, in ascending order.
    [[nodiscard]] std::span<const std::uint32_t> undecided() const { return undecided_; }

private:
    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    const passes::PairSearch* search_;
    device_input::PairSearchKind kind_;
    bool is_resident_;
    gpu::MappedBuffer scratch_;
    gpu::MappedBuffer arguments_;
    std::optional<graph::BoundResources> boxes_;  // where the pairs are found
    graph::DescriptorUpdates updates_;
    std::uint64_t scratch_bytes_ = 0;
    PairParts parts_;
    std::vector<std::unique_ptr<PairPartMemory>> memories_;  // of the parts
    std::vector<PairCounts> counts_;
    std::vector<std::uint32_t> undecided_;
};

}  // namespace nearfield::render
