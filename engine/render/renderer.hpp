#pragma once

#include <engine/base/unique_numbers.hpp>
#include <engine/gpu/device.hpp>
#include <engine/render/batch_resources.hpp>
#include <engine/render/computed_tiles.hpp>
#include <engine/render/pair_search_buffers.hpp>
#include <engine/render/pipeline_set.hpp>
#include <engine/render/tile_work.hpp>
#include <engine/render/world_query_buffers.hpp>
#include <nearfield/context.hpp>
#include <nearfield/result.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield::render {

/// Makes a technique on a device, of which the layout is, and at once its pipelines.
using MakeTileTechnique = std::unique_ptr<TileTechnique> (*)(const gpu::Device& device,
                                                             const graph::ComputeLayout& layout,
                                                             bool makes_pipelines);

/// Takes a batch to the device in one submission, or into a command buffer of the host. Owns what
/// all batches in flight share: pipelines, and by technique what tile batches need (TileTechnique).
/// Everything specific to a batch is in its BatchResources. The steady state allocates nothing and
/// creates nothing.
class Renderer {
public:
    /// Makes all pipelines of the settings' techniques and none later, or each when a batch is
    /// prepared, or memory made for pairs, that needs it. `make_drawn`: makes the technique that
    /// draws; null: there is none.
    Renderer(const gpu::Device& device, const Settings& settings, MakeTileTechnique make_drawn);

    /// The name of the format that gradients are blended in.
    [[nodiscard]] const char* gradient_format() const;

    /// Plans a query about points of technique raster, which there is.
    void plan_drawn_points(device_input::CurrentQuery& current, AnyResult& result) {
        drawn_->plan_points(current, result);
    }
    /// Resources for a batch of this renderer, which must outlive them.
    [[nodiscard]] std::unique_ptr<BatchResources> make_resources();
    /// Memory for searches for all pairs, likewise.
    [[nodiscard]] std::unique_ptr<PairSearchBuffers> make_pair_buffers(
        const device_input::PairQuestion& question, const PairTableCounts& reserve);
    /// The passes before such searches that take poses of the host, and those after them whose
    /// results stay on the device.
    [[nodiscard]] const passes::PairPoses& pair_poses() const { return passes_.pair_poses(); }
    [[nodiscard]] const passes::ExportPairs& export_pairs() const { return passes_.export_pairs(); }
    /// Says that such a search is recorded, for print().
    void note_pairs(const device_input::PairSearchKind& kind, bool takes_poses, bool is_resident);
    /// Memory for many questions about a world, likewise; and says that they are recorded.
    [[nodiscard]] std::unique_ptr<WorldQueryBuffers> make_world_query_buffers(
        device_input::WorldQuestion question);
    void note_world_queries(device_input::WorldQuestion question);
    /// The time that making pipelines has taken, which is in no other time.
    [[nodiscard]] double pipeline_milliseconds() const {
        return passes_.milliseconds() + (drawn_ == nullptr ? 0.0 : drawn_->pipeline_milliseconds());
    }
    /// How many records of one query that stay on the device there is room for, if there can be as
    /// many: more than any query before has had.
    [[nodiscard]] std::uint32_t expected_records() const { return expected_records_; }
    void note_records(std::uint32_t count) {
        expected_records_ = std::max(expected_records_, count + count / 8);
    }

    /// Differs from that of every other renderer.
    [[nodiscard]] std::uint32_t number() const { return number_; }

    /// Uploads the tile batches of a slot and their resident outputs, and reserves memory for their
    /// results; adds to the time of planning. All of it has to stay unchanged, and `slot`
    /// untouched, until the device is done. Also uploads the pairs that are searched, if any, of
    /// which nothing is needed afterwards. `shapes`: those that they name.
    void prepare(const device_input::ResidentOutputs& resident,
                 const device_input::SearchShapes& shapes, const device_input::GivenPairs& pairs,
                 SampleRoom room, BatchResources& slot, Timings& timings);
    /// Records the prepared tile batches and submits them; adds to the time of recording.
    void submit(BatchResources& slot, const Submission& order, Timings& timings);
    /// Records the prepared tile batches into a command buffer of the host, followed by a stamp
    /// (BatchResources::end_recording). Everything that can fail is done before anything is
    /// recorded.
    void record(BatchResources& slot, VkCommandBuffer commands, std::uint32_t stamp,
                Timings& timings);
    /// Waits for the submission, if any, and adds the times of the passes. The results are then in
    /// `slot`, except for tile batches that found more samples than they had memory for.
    void wait(BatchResources& slot, Timings& timings);
    /// Submits those tile batches again, with memory for all samples, overwriting the results of
    /// the others. Returns false if there are none.
    [[nodiscard]] bool submit_those_without_room(BatchResources& slot, Timings& timings);

    /// Drops the compiled graphs, except those of batches in flight, until the next batch.
    void trim() noexcept;

    /// Prints the graphs of the last batch, one after the other, each with a title, or that of a
    /// later search for pairs or of other questions about a world; empty before the first.
    [[nodiscard]] std::string print(GraphFormat format) const;

private:
    void record(BatchResources& slot, VkCommandBuffer commands);
    void forget_last_graphs();
    void note_search(const passes::PairSearch& search, const char* title);
    void upload_search(const device_input::SearchShapes& shapes,
                       const device_input::GivenPairs& pairs, SampleRoom room,
                       BatchResources& slot);
    void record_search(const GivenSearch& search, BatchResources& slot, VkCommandBuffer commands);

    const gpu::Device* device_;
    std::uint32_t number_ = next_owner_number();
    bool timestamps_;
    graph::ComputeLayout layout_;
    PipelineSet passes_;
    std::unique_ptr<TileTechnique> drawn_;  // null: there is none
    ComputeTechnique computed_;
    struct TitledGraph {
        const graph::CompiledGraph* graph;
        const char* title;
    };
    std::vector<TitledGraph> last_graphs_;  // for print(), beside those of tiles
    static constexpr std::uint32_t min_records = 16384;
    std::uint32_t expected_records_ = min_records;
    PairCounts max_counts_{};  // by a search of a batch, reserved for the next
};

}  // namespace nearfield::render
