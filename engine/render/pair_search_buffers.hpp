#pragma once

#include <engine/device_input/pair_question.hpp>
#include <engine/device_input/search_shapes.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/render/instance_buffers.hpp>
#include <engine/render/pair_outputs.hpp>
#include <engine/render/pose_source.hpp>
#include <engine/render/search_memory.hpp>
#include <nearfield/timings.hpp>
#include <passes/pair_search.hpp>

#include <shaders/pairs.h>

#include <cstdint>
#include <span>

namespace nearfield::render {

/// A search for all pairs of a world's instances: its memory and its submission, or what it has
/// recorded for a host.
class PairSearchBuffers {
public:
    /// The passes must stay. `reserve`: what there is room for at first, at least.
    PairSearchBuffers(const gpu::Device& device, const graph::ComputeLayout& layout,
                      const passes::PairSearch& passes, const device_input::PairQuestion& question,
                      const PairTableCounts& reserve, bool timestamps);
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

    /// Lets the device find all pairs. Nothing may be changed until finish(). Throws
    /// StatusException, (too_large) if the device cannot hold those of one instance, or they need
    /// more bytes than `memory_limit`. Adds the time of recording and submission.
    void begin(const device_input::SearchShapes& shapes, std::uint64_t memory_limit,
               Timings& timings);
    /// Whether finish() need not wait for what was begun.
    [[nodiscard]] bool is_done() const { return !is_submitted_ || submission_.is_done(); }
    /// Waits for what was begun; submits as often as it takes to have room for all. Throws as
    /// begin(). Adds the times of the waits and of the passes, and as begin().
    void finish(Timings& timings);

    /// In place of begin(): records the same into a command buffer of the host, which may submit it
    /// again and again. `headroom`: so many times what the last search has found has room. Throws
    /// as begin(); then nothing is recorded.
    void record(VkCommandBuffer commands, const device_input::SearchShapes& shapes,
                std::uint64_t memory_limit, double headroom, Timings& timings);
    /// In place of finish(), once the device is done, and as often as it is: reads what the last
    /// execution left. Throws StatusException: (not_executed) if there was none, (overflow) if it
    /// had no room, which the next begin() or record() makes. Adds the times of the passes.
    void collect(Timings& timings);
    /// What the last search that has ended found, at any time; nothing while another one that was
    /// begun has not finished, or if recorded commands were not executed yet.
    [[nodiscard]] PairTableCounts found() const;
    [[nodiscard]] PairTableCounts room() const {
        PairTableCounts room = memory_.room();
        outputs_.limit(room);
        return room;
    }
    /// Throws StatusException (overflow) if the host's buffers have no room for what was read last.
    void require_room_of_target() const;
    /// Of the last search nothing is of use.
    void forget_counts() { has_results_ = false; }

    /// Of the last search: the pairs that it was about, and those that have rows.
    [[nodiscard]] std::uint32_t candidates() const {
        return has_results_ ? memory_.candidates() : 0;
    }
    [[nodiscard]] std::uint32_t row_count() const { return memory_.row_count(); }
    /// The rows that the CPU has to decide, in ascending order.
    [[nodiscard]] std::span<const std::uint32_t> undecided() const { return memory_.undecided(); }
    /// In ascending order of the instances.
    [[nodiscard]] const shaders::PairRowData& row(std::uint32_t number) const {
        const PairPartMemory& part = memory_.part_of_row(number);
        return part.row(number - part.first_row());
    }
    /// Those that a row names. Only if the host reads them.
    [[nodiscard]] std::span<const shaders::FoundPointData> records(std::uint32_t row,
                                                                   std::uint32_t first,
                                                                   std::uint32_t count) const {
        return {memory_.part_of_row(row).records() + first, count};
    }

private:
    [[nodiscard]] PairLimits limits() const;
    [[nodiscard]] SearchInput input() const;
    void lay_out();
    void upload(const device_input::SearchShapes& shapes, std::uint64_t memory_limit,
                double headroom);
    // `takes_poses`: of the host; otherwise the instances are placed already.
    // `pairs`: see SearchMemory::clear_counts.
    void prepare(bool takes_poses, std::uint32_t pairs);
    void bind_ends(bool takes_poses);
    void write_commands(VkCommandBuffer commands, bool takes_poses);
    void submit(bool takes_poses, Timings& timings);
    [[nodiscard]] bool were_executed() const;
    void read_results();
    void grow(double headroom);

    const gpu::Device* device_;
    gpu::Submission submission_;
    gpu::Timestamps timestamps_;
    std::uint64_t memory_limit_ = 0;  // of the last search
    PoseSource poses_;
    PairOutputs outputs_;
    InstanceBuffers world_;
    SearchMemory memory_;
    std::uint32_t laid_out_world_ = 0;  // revision of the instances
    std::uint32_t bound_poses_ = 0;     // revision of those that commands take; 0: none
    std::uint32_t bound_outputs_ = 0;   // revision of what they leave on the device
    bool is_submitted_ = false;
    bool is_laid_out_ = false;
    bool is_bound_ = false;     // since then, as are the next two
    bool is_recorded_ = false;  // for submit()
    bool is_for_host_ = false;  // recorded for the host
    bool has_results_ = false;  // of the last search of these parts
};

}  // namespace nearfield::render
