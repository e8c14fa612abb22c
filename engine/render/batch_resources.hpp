#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <engine/plan/tile_batch.hpp>
#include <engine/render/compiled_graph.hpp>
#include <engine/render/compute_buffers.hpp>
#include <engine/render/given_search.hpp>
#include <engine/render/pipeline_set.hpp>
#include <engine/render/resident_buffers.hpp>
#include <passes/record_context.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::render {

/// Byte offsets of a tile batch's parts in the common buffers.
struct InputParts {
    std::uint64_t tiles = 0, geometry = 0, points = 0, field_points = 0, end = 0;
    std::uint64_t groups_end = 0;               ///< of the groups that follow the tiles
    std::uint64_t tile_meshes = 0, meshes = 0;  ///< in the buffer of meshes
};
struct OutputParts {
    std::uint64_t points = 0, field = 0, summaries = 0, samples = 0, end = 0;
};

/// How the commands reach the device.
enum class SubmissionState {
    none,
    submitted,  ///< submitted by BatchResources, whose fence signals completion
    recorded,   ///< recorded into a command buffer of the host, which reports completion
};

/// The device's side of one tile batch.
struct TileBatchOnDevice {
    std::shared_ptr<CompiledGraph> graph;  ///< kept for as long as the device may use its images
    const plan::TileBatch* batch = nullptr;
    InputParts input;
    OutputParts output;
    std::uint32_t sample_capacity = 0;
    std::uint32_t sample_count = 0;  ///< found; only sample_capacity of them were stored
    bool had_long_searches = false;  ///< in crowded blocks of fields, which are not answered

    [[nodiscard]] bool had_room() const { return sample_count <= sample_capacity; }
};

/// The device's side of one batch in flight: everything that the host must not touch before the
/// device is done with it. Holds all tile batches of the batch, each with resources of its own,
/// which its passes bind, and parts of the common buffers. Pipelines, compiled graphs and their
/// images belong to the Renderer and are shared by all batches in flight. Keeps its memory; in the
/// steady state nothing is created.
class BatchResources {
public:
    /// The passes must outlive this. `timestamps`: they are timed.
    BatchResources(const gpu::Device& device, const graph::ComputeLayout& layout,
                   const PipelineSet& passes, bool timestamps);
    /// Waits for its own submission if the device is still working on it. Waiting for commands
    /// recorded for the host is up to the host.
    ~BatchResources();
    BatchResources(const BatchResources&) = delete;
    BatchResources& operator=(const BatchResources&) = delete;

    /// Uploads tile batches and the tables of their resident outputs. Both have to stay unchanged
    /// until the next upload, and no commands of this object may be in flight.
    void upload(std::span<const plan::TileBatch> tile_batches,
                const plan::ResidentOutputs& resident);
    /// Selects the first `count` tile batches for the next submission.
    void run(std::uint32_t count);
    void run_those_without_room();
    [[nodiscard]] std::span<const std::uint32_t> running() const { return running_; }
    /// Lays out the outputs of the selected tile batches and binds what their passes use.
    void lay_out_output();

    /// Uploads the pairs that are searched, after the tile batches; see GivenSearch::upload().
    void upload_search(const plan::SearchShapes& shapes, const plan::GivenPairs& pairs,
                       const PairCounts& expected);
    /// The search of the commands; null if they have none.
    [[nodiscard]] const GivenSearch* running_search() const {
        return is_searching_ ? search_.get() : nullptr;
    }

    [[nodiscard]] TileBatchOnDevice& tile_batch(std::uint32_t number) {
        return tile_batches_[number];
    }
    [[nodiscard]] const TileBatchOnDevice& tile_batch(std::uint32_t number) const {
        return tile_batches_[number];
    }
    /// What the passes of a tile batch are recorded from, once its output is laid out.
    [[nodiscard]] passes::RecordContext record_context(std::uint32_t number) const;
    /// The resources of a tile batch.
    [[nodiscard]] const graph::BoundResources& bound(std::uint32_t number) const {
        return *bound_[number].current;
    }

    /// The resident outputs; their commands are part of a batch's first submission.
    [[nodiscard]] const ResidentBuffers& resident() const { return resident_; }
    [[nodiscard]] bool has_resident_outputs() const { return has_resident_outputs_; }
    /// The ranges of the device's words that the host reads as well.
    [[nodiscard]] std::span<const VkBufferCopy> copies() const { return copies_; }
    [[nodiscard]] const graph::BoundResources& bound_copies() const { return *bound_copies_; }

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

    /// The results of a tile batch: by point; of all fields; by tile (overlap tiles only); and the
    /// samples of the tiles that list theirs, in any order. Valid after wait(), until the next
    /// upload.
    [[nodiscard]] std::span<const std::uint32_t> points(std::uint32_t number) const;
    [[nodiscard]] std::span<const std::uint32_t> field_words(std::uint32_t number) const;
    [[nodiscard]] std::span<const plan::TileSummary> summaries(std::uint32_t number) const;
    [[nodiscard]] std::span<const plan::SampleData> samples(std::uint32_t number) const;

private:
    void make_room_for(std::size_t tile_batches);
    void lay_out_input(TileBatchOnDevice& on_device, std::uint64_t& input_end,
                       std::uint64_t& mesh_end) const;
    void copy_input(const TileBatchOnDevice& on_device) const;
    void empty_output(const TileBatchOnDevice& on_device) const;
    void find_copies(const TileBatchOnDevice& on_device);
    void reserve_words(std::uint64_t end);
    void reserve_timestamps();
    void bind_export();
    void bind_copies();
    /// The buffer into which a tile batch writes the words of its fields.
    [[nodiscard]] const gpu::MappedBuffer& words_of(const TileBatchOnDevice& on_device) const;
    void bind(std::uint32_t number);
    void bind_input(const TileBatchOnDevice& on_device, graph::BoundResources& resources) const;
    [[nodiscard]] std::uint64_t align(std::uint64_t offset) const;
    void require_stamp();

    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    const PipelineSet* pipelines_;
    gpu::Submission submission_;
    gpu::Timestamps timestamps_;
    std::uint32_t passes_ = 0;  // of the tile batches and their exports
    gpu::MappedBuffer mesh_;
    gpu::MappedBuffer input_;
    gpu::MappedBuffer read_back_;
    /// Laid out like the read-back, for tile batches whose results stay on the device.
    gpu::MappedBuffer words_;
    ResidentBuffers resident_;
    bool has_resident_outputs_ = false;
    std::vector<VkBufferCopy> copies_;
    std::vector<ResidentBuffers::Words> export_words_;  // by tile batch
    /// The resources of a tile batch, one for each graph that it was last executed with and that
    /// there still is, so that kinds of batches can alternate.
    struct Bound {
        struct WithGraph {
            std::weak_ptr<const CompiledGraph> graph;
            std::unique_ptr<graph::BoundResources> resources;
        };
        std::vector<WithGraph> all;
        graph::BoundResources* current = nullptr;

        [[nodiscard]] graph::BoundResources& use(const std::shared_ptr<CompiledGraph>& graph,
                                                 const graph::ComputeLayout& layout);
    };
    std::vector<Bound> bound_;  // by tile batch
    std::optional<graph::BoundResources> bound_copies_;
    graph::DescriptorUpdates updates_;
    /// By tile batch; null for those that never used the compute technique. Each has scratch memory
    /// of its own, since no barrier separates the tile batches of a submission.
    std::vector<std::unique_ptr<ComputeBuffers>> compute_;
    std::vector<TileBatchOnDevice> tile_batches_;
    std::vector<std::uint32_t> running_;
    std::unique_ptr<GivenSearch> search_;  // null until there are pairs to search
    bool is_searching_ = false;
    SubmissionState state_ = SubmissionState::none;
    std::uint64_t stamp_offset_ = 0;  // in the read-back, which holds 0 there until execution
    std::uint32_t stamp_ = 0;
};

}  // namespace nearfield::render
