#pragma once

#include <engine/answer_jobs.hpp>
#include <engine/choose/chooser.hpp>
#include <engine/hand_over_builder.hpp>
#include <engine/plan/hand_over.hpp>
#include <engine/plan/planner.hpp>
#include <engine/plan/round.hpp>
#include <engine/renderer.hpp>
#include <engine/results.hpp>
#include <engine/stopwatch.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield {

/// What makes rounds of queries, and answers. Its scratch memory serves one batch after the other:
/// nothing of it is needed once a batch is submitted, or once its answers are made.
struct Planning {
    choose::Chooser chooser;
    plan::Planner planner;
    plan::RoundBuilder builder;
    AnswerJobs answers;

    Planning(const plan::PlanLimits& limits, const CostModel& costs, const JobSystem& jobs)
        : chooser(costs, limits.techniques),
          planner(limits),
          builder(limits.subpixel),
          answers(jobs) {}
};

/// One batch from queries to results, in two steps: what is done up to its submission, and what is
/// left for when the device has done its part. In between everything the batch needs is here (but
/// for the polygons, which whoever finds them has to keep as they are). Keeps its memory from batch
/// to batch.
class BatchRunner {
public:
    /// Planning and renderer are shared with other runners and must outlive this one. Without a
    /// renderer (null) there is no device: the planner must refuse whatever needs one.
    BatchRunner(Planning& planning, Renderer* renderer);

    /// Copies the queries, picks their techniques, plans them and submits their rounds with the
    /// semaphores of `order`; where nothing is to be rendered, the semaphores alone, if any. Then
    /// answers what the CPU answers, while the device is at work: what fails there collect() says.
    /// Does not wait, but for a batch that a Failure left on the device.
    void submit(std::span<const AnyQuery> queries, const plan::FindShape& find_shape,
                const Submission& order = {});
    /// The same, but records the rounds into a command buffer of the host, as the last thing: where
    /// it throws, nothing was recorded. What would take a second submission is refused in its own
    /// result. `stamp`: as RenderSlot::end_recording() takes it.
    void record(std::span<const AnyQuery> queries, const plan::FindShape& find_shape,
                VkCommandBuffer commands, std::uint32_t stamp);

    /// Whose part is left to do.
    [[nodiscard]] Flight flight() const {
        return slot_ == nullptr ? Flight::none : slot_->flight();
    }
    /// collect() would not wait for what was submitted.
    [[nodiscard]] bool is_done();
    /// Waits for the device and makes the results; what was recorded has to be done. Normals of
    /// contacts that are to be gradients are left to GradientNormals.
    void collect();

    /// What stays on the device of a query, after submit(). Throws Failure where there is nothing,
    /// for each reason by name.
    [[nodiscard]] ResidentField resident(QueryHandle<DistanceFieldQuery> handle) const;
    [[nodiscard]] ResidentSamples resident(QueryHandle<IntersectionQuery> handle) const;
    template <class Query>
    [[nodiscard]] ResidentRecords resident(QueryHandle<Query> handle) const {
        require_resident(handle);
        return resident_records(handle.index);
    }

    /// Of the last batch, until the next: complete after collect(), but for their total time. May
    /// be swapped for other results, whose memory is then reused.
    [[nodiscard]] Results& results() { return results_; }
    [[nodiscard]] const plan::Plan& plan() const { return plan_; }
    [[nodiscard]] std::span<const std::uint32_t> point_words() const {
        return decoder_.point_words();
    }

private:
    void begin(std::span<const AnyQuery> queries, const plan::FindShape& find_shape,
               plan::Submissions submissions);
    void keep_off_the_device();
    [[nodiscard]] bool has_device_work() const;
    void answer_on_cpu();
    void copy(std::span<const AnyQuery> queries);
    void begin_timings();
    void make_rounds();
    void wait();
    void decode(std::uint32_t number);
    template <class Query>
    void require_resident(QueryHandle<Query> handle) const;
    [[nodiscard]] ResidentRecords resident_records(std::uint32_t query) const;

    Planning* planning_;
    Renderer* renderer_;
    std::unique_ptr<RenderSlot> slot_;  // null without a renderer
    std::vector<AnyQuery> queries_;
    std::vector<Vector2> points_;            // of the queries
    std::vector<plan::QueryShapes> shapes_;  // by query
    plan::Plan plan_;
    std::vector<plan::Round> rounds_;  // the first Plan::rounds of them
    HandOverBuilder hand_over_builder_;
    plan::HandOver hand_over_;
    ResultDecoder decoder_;
    Results results_;
    Stopwatch submitted_;
    std::optional<double> device_milliseconds_;  // from submission until it was seen to be done
    std::exception_ptr late_failure_;            // of a batch that was submitted all the same
};

}  // namespace nearfield
