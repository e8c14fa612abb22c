#pragma once

#include <engine/base/stopwatch.hpp>
#include <engine/batch/device_answers.hpp>
#include <engine/batch/result_writer.hpp>
#include <engine/batch/technique_choice.hpp>
#include <engine/device_input/planner.hpp>
#include <engine/device_input/resident_outputs.hpp>
#include <engine/device_input/resident_outputs_builder.hpp>
#include <engine/queries/checked_query.hpp>
#include <engine/render/renderer.hpp>
#include <engine/solvers/solver_jobs.hpp>
#include <nearfield/result.hpp>
#include <nearfield/tile.hpp>

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::batch {

/// What turns queries into answers, on the CPU and for a device. Its scratch memory serves one
/// batch after the other: none of it is needed once a batch is submitted or its answers are
/// written.
struct Planning {
    queries::QueryLimits limits;
    TechniqueRule rule;
    solvers::SolverJobs solvers;
    device_input::Planner planner;
    ResultWriter writer;

    Planning(const queries::QueryLimits& limits_of_device,
             const std::optional<DeviceThresholds>& thresholds, const JobSystem& jobs)
        : limits(queries::with_affordable_atlas(limits_of_device)),
          rule{limits.techniques, limits.largest_range, thresholds},
          solvers(limits, jobs),
          planner(limits),
          writer(limits) {}
};

/// Runs one batch from queries to results, in two steps: everything up to its submission, and the
/// rest once the device is done. In between, it holds everything the batch needs, except for the
/// polygons, which their owner has to keep unchanged. Keeps its memory from batch to batch.
class BatchRunner {
public:
    /// Planning and renderer are shared with other runners and must outlive this one. Without a
    /// renderer (null) there is no device: the planner must reject everything that needs one.
    BatchRunner(Planning& planning, render::Renderer* renderer);

    /// Whether the next batches state the time of each query.
    void time_queries(bool on) { times_queries_ = on; }

    /// Copies the queries, chooses their techniques and checks them; plans what the device answers
    /// and submits its tile batches with the semaphores of `order`; if nothing is rendered, only
    /// the semaphores, if any. Then answers the CPU's queries while the device is working; errors
    /// there are reported by collect() if there were submissions. Does not wait, except for a batch
    /// that an exception left on the device. `laps`: begun with the call; each part that takes time
    /// ends one.
    void submit(std::span<const AnyQuery> queries, const queries::FindShape& find_shape, Laps& laps,
                const Submission& order = {});
    /// The same, but records the tile batches into a command buffer of the host, as the last step:
    /// if it throws, nothing was recorded. `stamp`: see BatchResources::end_recording().
    void record(std::span<const AnyQuery> queries, const queries::FindShape& find_shape, Laps& laps,
                VkCommandBuffer commands, std::uint32_t stamp);

    /// Reserves the device memory of such a batch and starts nothing: its resident outputs are
    /// known until the next batch.
    void reserve(std::span<const AnyQuery> queries, const queries::FindShape& find_shape);
    /// Drops the device memory, which the next batch allocates again. Not while a batch is in
    /// flight. Keeps it if the device has none left for what replaces it.
    void trim() noexcept;

    /// Who still has to finish the commands.
    [[nodiscard]] render::SubmissionState submission_state() const {
        return slot_ == nullptr ? render::SubmissionState::none : slot_->submission_state();
    }
    /// Returns whether collect() would return without waiting for a submission.
    [[nodiscard]] bool is_done();
    /// Waits for the device and writes the results; recorded commands have to be done. If the call
    /// ends before, the results that are not done say so.
    void collect(Laps& laps);

    /// The resident outputs of a query, after submit(). Throws a StatusException that names the
    /// reason if there are none.
    [[nodiscard]] FieldOnDevice on_device(QueryHandle<DistanceFieldQuery> handle) const;
    [[nodiscard]] SamplesOnDevice on_device(QueryHandle<IntersectionQuery> handle) const;
    template <class Query>
    [[nodiscard]] PointsOnDevice on_device(QueryHandle<Query> handle) const {
        require_on_device(handle);
        return resident_records(handle.index);
    }

    /// The results of the last batch, until the next one starts: complete after collect(), except
    /// for their total time. May be swapped for other results, whose memory is then reused.
    [[nodiscard]] Results& results() { return results_; }
    /// The time that making pipelines has taken so far.
    [[nodiscard]] double pipeline_milliseconds() const {
        return renderer_ == nullptr ? 0.0 : renderer_->pipeline_milliseconds();
    }
    /// The number of queries of the last batch that a device answers.
    [[nodiscard]] std::size_t device_queries() const { return for_device_.size(); }
    /// Replaces `reports` by one on each of their tiles.
    void list_tiles(std::vector<TileReport>& reports) const;

private:
    void begin(std::span<const AnyQuery> queries, const queries::FindShape& find_shape,
               render::SampleRoom room, Laps& laps);
    [[nodiscard]] bool has_device_work() const;
    void check_queries();
    void take(const queries::CheckedQuery& checked);
    void solve(Laps& laps);
    void solve_what_had_no_room();
    void begin_timings(std::size_t queries);
    void resize_results(std::size_t queries);
    void time_device();
    [[nodiscard]] std::optional<std::size_t> only_query_on_device() const;
    void make_tile_batches();
    void note_places(const device_input::TileBatch& batch, std::uint32_t number);
    void finish_plan();
    void wait();
    void read_back(Laps& laps);
    void take_found_pairs(bool was_recorded);
    void check_room_for_records();
    void decode(const render::TileWork& tiles, std::uint32_t number);
    template <class Query>
    void require_on_device(QueryHandle<Query> handle) const;
    [[nodiscard]] PointsOnDevice resident_records(std::uint32_t query) const;

    Planning* planning_;
    render::Renderer* renderer_;
    std::unique_ptr<render::BatchResources> slot_;  // null without a renderer
    // Points of fields are read while the batch is planned; later they may be gone.
    std::vector<AnyQuery> queries_;
    std::vector<queries::QueryShapes> shapes_;  // by query
    std::vector<queries::CheckedQuery> for_cpu_;
    std::vector<std::uint32_t> for_device_;  // their places in the batch
    // Only if a device answers some of the queries.
    device_input::Plan plan_;
    device_input::ResidentOutputsBuilder resident_outputs_builder_;
    device_input::ResidentOutputs resident_;
    DeviceAnswers answers_;
    Results results_;
    std::vector<AnyResult> spare_results_;  // with memory, of larger batches
    bool times_queries_ = false;
    Stopwatch submitted_;
    std::optional<double> device_milliseconds_;  // from submission until completion was observed
    std::exception_ptr late_failure_;            // of a batch that was submitted nevertheless
};

}  // namespace nearfield::batch
