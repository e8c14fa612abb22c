#pragma once

#include <engine/device_input/resident_outputs.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/render/computed_tiles.hpp>
#include <engine/render/given_search.hpp>
#include <engine/render/pipeline_set.hpp>
#include <engine/render/resident_buffers.hpp>
#include <engine/render/tile_work.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield::render {

/// How the commands reach the device.
enum class SubmissionState {
    none,
    submitted,  ///< submitted by BatchResources, whose fence signals completion
    recorded,   ///< recorded into a command buffer of the host, which reports completion
};

/// The device's side of one batch in flight: everything that the host must not touch before the
/// device is done with it. Holds the tile batches of each technique, the search, the resident
/// outputs and what submits them. What batches in flight share belongs to the Renderer. Keeps its
/// memory; in the steady state nothing is created.
class BatchResources {
public:
    /// All arguments must outlive this. `drawn`: of the technique that draws; null: there is none.
    /// `timestamps`: passes are timed.
    BatchResources(const gpu::Device& device, const graph::ComputeLayout& layout,
                   const PipelineSet& passes, TileTechnique* drawn, ComputeTechnique& computed,
                   bool timestamps);
    /// Waits for its own submission if the device is still working on it. Waiting for commands
    /// recorded for the host is up to the host.
    ~BatchResources();
    BatchResources(const BatchResources&) = delete;
    BatchResources& operator=(const BatchResources&) = delete;

    /// The tile batches, by technique.
    [[nodiscard]] std::span<const std::unique_ptr<TileWork>> tiles() const { return tiles_; }
    /// Those of technique compute among them.
    [[nodiscard]] const ComputedTiles& computed() const { return *computed_; }

    /// Uploads the tile batches and the tables of their resident outputs, which have to stay
    /// unchanged until the next upload, and selects all for the next submission. No commands of
    /// this object may be in flight.
    void prepare(const device_input::ResidentOutputs& resident, SampleRoom room);
    /// Selects what found more than it had memory for; false if there is nothing.
    [[nodiscard]] bool select_those_without_room();
    /// Lays out the outputs of what is selected and binds what the passes use.
    void lay_out_output();

    /// Uploads the pairs that are searched, after the tile batches; see GivenSearch::upload().
    void upload_search(const device_input::SearchShapes& shapes,
                       const device_input::GivenPairs& pairs, const PairCounts& expected);
    /// The search of the commands; null if they have none.
    [[nodiscard]] const GivenSearch* running_search() const {
        return is_searching_ ? search_.get() : nullptr;
    }

    /// The resident outputs; their commands are part of a batch's first submission.
    [[nodiscard]] const ResidentBuffers& resident() const { return resident_; }
    [[nodiscard]] bool has_resident_outputs() const { return has_resident_outputs_; }

    /// The command buffer, empty.
    [[nodiscard]] VkCommandBuffer begin();
    [[nodiscard]] gpu::Timestamps& timestamps() { return timestamps_; }
    void submit(const Submission& order = {});
    /// Submits the semaphores of a batch that has no commands.
    void submit_semaphores(const Submission& order) { submission_.submit_semaphores(order); }
    /// Ends the recording into the host's command buffer. `stamp`, never 0 and never used before,
    /// shows later whether the commands were executed.
    void end_recording(VkCommandBuffer commands, std::uint32_t stamp);
    /// State of the commands until they have been waited for.
    [[nodiscard]] SubmissionState submission_state() const { return state_; }
    /// Returns whether wait() would return at once; for recorded commands only the host knows.
    [[nodiscard]] bool is_done() const {
        return state_ != SubmissionState::submitted || submission_.is_done();
    }
    /// Waits for submitted commands; recorded commands have to be done. Throws StatusException
    /// (not_executed) if recorded commands were never executed.
    void wait();
    /// Releases the compiled graphs; not while in flight.
    void release();

private:
    void reserve_timestamps();
    void require_stamp();

    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    const PipelineSet* pipelines_;
    gpu::Submission submission_;
    gpu::Timestamps timestamps_;
    std::uint32_t passes_ = 0;  // of the tile batches and their exports
    std::vector<std::unique_ptr<TileWork>> tiles_;
    ComputedTiles* computed_ = nullptr;  // the last of them
    ResidentBuffers resident_;
    bool has_resident_outputs_ = false;
    graph::DescriptorUpdates updates_;
    std::unique_ptr<GivenSearch> search_;  // null until there are pairs to search
    bool is_searching_ = false;
    SubmissionState state_ = SubmissionState::none;
    gpu::MappedBuffer stamp_buffer_;  // holds 0 until execution
    std::uint32_t stamp_ = 0;
};

}  // namespace nearfield::render
