#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/plan/pair_question.hpp>
#include <engine/plan/search_shapes.hpp>
#include <engine/render/instance_buffers.hpp>
#include <engine/render/pair_counts.hpp>
#include <engine/render/pair_outputs.hpp>
#include <engine/render/pose_source.hpp>
#include <nearfield/timings.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_sets.hpp>
#include <passes/pair_search.hpp>

#include <shaders/pairs.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::render {

/// The memory of a search for all pairs of a world's instances, with its descriptor sets and its
/// submission, or what it has recorded for a host. It only grows.
class PairSearchBuffers {
public:
    PairSearchBuffers(const gpu::Device& device, const passes::ComputeLayout& layout,
                      const plan::PairQuestion& question, bool timestamps);
    /// Waits for the device if it is still working.
    ~PairSearchBuffers();
    PairSearchBuffers(const PairSearchBuffers&) = delete;
    PairSearchBuffers& operator=(const PairSearchBuffers&) = delete;

    /// The instances and their shapes.
    [[nodiscard]] InstanceBuffers& world() { return world_; }
    /// Where the places of instances come from, if the host gives their poses.
    [[nodiscard]] PoseSource& poses() { return poses_; }
    [[nodiscard]] const PoseSource& poses() const { return poses_; }
    /// What stays on the device.
    [[nodiscard]] PairOutputs& outputs() { return outputs_; }
    [[nodiscard]] const PairOutputs& outputs() const { return outputs_; }

    /// Lets the device find all pairs. The passes must stay until finish(), and nothing may be
    /// changed. Throws StatusException, (too_large) if the device cannot hold them, or they need
    /// more bytes than `memory_limit`. Adds the time of recording and submission.
    void begin(const passes::PairSearch& passes, const plan::SearchShapes& shapes,
               std::uint64_t memory_limit, Timings& timings);
    /// Whether finish() need not wait for what was begun.
    [[nodiscard]] bool is_done() const { return !is_submitted_ || submission_.is_done(); }
    /// Waits for what was begun; submits as often as it takes to have room for all. Throws as
    /// begin(). Adds the times of the waits and of the passes, and as begin().
    void finish(Timings& timings);

    /// In place of begin(): records the same into a command buffer of the host, which may submit it
    /// again and again. Throws as begin(); then nothing is recorded.
    void record(VkCommandBuffer commands, const passes::PairSearch& passes,
                const plan::SearchShapes& shapes, std::uint64_t memory_limit, Timings& timings);
    /// In place of finish(), once the device is done, and as often as it is: reads what the last
    /// execution left. Throws StatusException: (not_executed) if there was none, (overflow) if it
    /// had no room, which the next begin() or record() makes. Adds the times of the passes.
    void collect(Timings& timings);
    /// Of the last search nothing is of use.
    void forget_counts() { counts_ = {}; }

    [[nodiscard]] const PairCounts& counts() const { return counts_; }
    /// The rows that the CPU has to decide, in ascending order.
    [[nodiscard]] std::span<const std::uint32_t> undecided() const { return undecided_; }
    /// In ascending order of the instances.
    [[nodiscard]] std::span<const plan::PairRowData> rows() const {
        return {rows_data() + 1, counts_[plan::row_total]};
    }
    /// Only if the host reads them.
    [[nodiscard]] std::span<const plan::FoundPointData> records() const {
        return {reinterpret_cast<const plan::FoundPointData*>(records_.data()),
                counts_[plan::record_total]};
    }

private:
    [[nodiscard]] const plan::PairRowData* rows_data() const {
        return reinterpret_cast<const plan::PairRowData*>(rows_.data());
    }
    struct Bytes {
        std::uint64_t scratch = 0;
        std::uint64_t records = 0;
        std::uint64_t rows = 0;
        std::uint64_t resident_records = 0;
        std::uint64_t resident_rows = 0;

        [[nodiscard]] std::uint64_t largest() const {
            return std::max({scratch, records, rows, resident_records, resident_rows});
        }
        [[nodiscard]] std::uint64_t sum() const {
            return scratch + records + rows + resident_records + resident_rows;
        }
    };
    [[nodiscard]] Bytes place_arrays();
    [[nodiscard]] std::uint64_t records_bytes() const {
        const std::uint32_t found =
            kind_.points == plan::FoundPoints::packed ? item_.capacities[plan::record_total] : 0;
        return std::max(found, 1U) * sizeof(plan::FoundPointData);
    }
    void lay_out();
    void bind() const;
    void upload(const passes::PairSearch& passes, const plan::SearchShapes& shapes,
                std::uint64_t memory_limit);
    // `takes_poses`: of the host; otherwise the instances are placed already.
    void prepare(bool takes_poses);
    void bind_ends(bool takes_poses);
    void write_commands(VkCommandBuffer commands, bool takes_poses);
    void submit(bool takes_poses, Timings& timings);
    [[nodiscard]] PairCounts read_counts() const;
    void read_undecided();
    void read_results();
    [[nodiscard]] std::optional<PairCounts> executed_counts() const;
    void grow(const PairCounts& counts);

    const gpu::Device* device_;
    const passes::ComputeLayout* layout_;
    plan::PairSearchKind kind_;
    gpu::Submission submission_;
    gpu::Timestamps timestamps_;
    const passes::PairSearch* passes_ = nullptr;  // of the last search, as is the limit
    std::uint64_t memory_limit_ = 0;
    PoseSource poses_;
    PairOutputs outputs_;
    InstanceBuffers world_;
    gpu::MappedBuffer scratch_;
    gpu::MappedBuffer arguments_;
    gpu::MappedBuffer records_;
    gpu::MappedBuffer rows_;
    gpu::MappedBuffer count_memory_;
    gpu::Owned<VkBufferView> scratch_texels_;  // of the scratch memory
    passes::DescriptorSets sets_;
    passes::PairSearch::Item item_;
    std::uint64_t scratch_bytes_ = 0;
    std::uint32_t laid_out_world_ = 0;  // revision of the instances
    std::uint32_t bound_poses_ = 0;     // revision of those that commands take; 0: none
    std::uint32_t bound_outputs_ = 0;   // revision of what they leave on the device
    bool is_submitted_ = false;
    bool is_laid_out_ = false;
    bool is_bound_ = false;     // since then, as are the next two
    bool is_recorded_ = false;  // for submit()
    bool is_for_host_ = false;  // recorded for the host
    std::vector<std::uint32_t> undecided_;
    PairCounts counts_{};
    PairCounts needed_{};  // capacities without anything to spare
};

}  // namespace nearfield::render
