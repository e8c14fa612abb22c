#pragma once

#include <engine/device_input/search_shapes.hpp>
#include <engine/device_input/world_question.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/render/instance_buffers.hpp>
#include <nearfield/timings.hpp>
#include <passes/world_queries.hpp>

#include <cstddef>
#include <cstdint>

namespace nearfield::render {

/// The memory of many questions about a world's instances, with its submission. It only
/// grows.
class WorldQueryBuffers {
public:
    /// The passes must stay.
    WorldQueryBuffers(const gpu::Device& device, const graph::ComputeLayout& layout,
                      const passes::WorldQueries& passes, device_input::WorldQuestion question,
                      bool timestamps);
    /// Waits for the device if it is still working.
    ~WorldQueryBuffers();
    WorldQueryBuffers(const WorldQueryBuffers&) = delete;
    WorldQueryBuffers& operator=(const WorldQueryBuffers&) = delete;

    /// The instances and their shapes.
    [[nodiscard]] InstanceBuffers& world() { return world_; }

    /// Makes room for so many questions, after those of the instances; returns where they have to
    /// be written. Throws StatusException (too_large) if they, or all boxes and answers, are more
    /// than the device's shaders reach in a buffer, or all memory is more than `memory_limit`.
    [[nodiscard]] std::byte* reserve(std::uint64_t count, std::uint64_t memory_limit);
    /// Lets the device answer them; nothing may be changed until finish(). `push`: who is asked.
    /// Adds the time of recording and submission.
    void begin(const device_input::SearchShapes& shapes, const shaders::WorldQueryPush& push,
               Timings& timings);
    /// Whether finish() need not wait for what was begun.
    [[nodiscard]] bool is_done() const { return !is_submitted_ || submission_.is_done(); }
    /// Waits for what was begun. Adds the times of the wait and of the passes.
    void finish(Timings& timings);

    /// One after the other.
    [[nodiscard]] const std::byte* answers() const { return answers_.data(); }

private:
    void bind();

    const gpu::Device* device_;
    const passes::WorldQueries* passes_;
    std::uint64_t question_bytes_;
    std::uint64_t answer_bytes_;
    gpu::Submission submission_;
    gpu::Timestamps timestamps_;
    InstanceBuffers world_;
    gpu::MappedBuffer questions_;
    gpu::MappedBuffer scratch_;
    gpu::MappedBuffer answers_;
    graph::BoundResources resources_;
    graph::DescriptorUpdates updates_;
    passes::WorldQueries::Input input_;
    bool is_submitted_ = false;
};

}  // namespace nearfield::render
