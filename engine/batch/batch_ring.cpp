#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/batch/batch_ring.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/queries/field_grid.hpp>
#include <engine/queries/overlap_regions.hpp>
#include <nearfield/on_device.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace nearfield::batch {
namespace {

/// What stays on the device of a query with so many points.
std::uint64_t bytes_of_points(double points) {
    return sizeof(SummaryData) + static_cast<std::uint64_t>(std::ceil(points)) * sizeof(PointData);
}

}  // namespace

BatchRing::BatchRing(std::uint32_t frames, const queries::QueryLimits& limits,
                     const std::optional<DeviceThresholds>& thresholds, const JobSystem& jobs,
                     render::Renderer* renderer, ShapeStore& shapes)
    : shapes_(&shapes), planning_(limits, thresholds, jobs) {
    for (std::uint32_t i = 0; i < frames; ++i) {
        frames_.push_back(std::make_unique<Frame>(Frame{BatchRunner(planning_, renderer), {}, i}));
    }
}

BatchRing::Frame* BatchRing::find(Ticket ticket) {
    if (ticket.number == 0 || ticket.context != shapes_->errors().context()) {
        return nullptr;
    }
    for (const auto& frame : frames_) {
        if (frame->number == ticket.number) {
            return frame.get();
        }
    }
    return nullptr;
}

BatchRing::Frame& BatchRing::require(Ticket ticket) {
    Frame* const frame = find(ticket);
    if (frame == nullptr) {
        const std::string name = "ticket " + std::to_string(ticket.number);
        throw StatusException(
            {StatusCode::unknown_ticket,
             ticket == Ticket{} ? "the ticket names no batch"
             : ticket.context != shapes_->errors().context()
                 ? name + " is of another context (number " + std::to_string(ticket.context) +
                       "; this one is number " + std::to_string(shapes_->errors().context()) + ")"
                 : name + " was collected already, or never issued by this context"});
    }
    return *frame;
}

BatchRing::Frame& BatchRing::free_frame() {
    for (const auto& frame : frames_) {
        if (frame->number == 0) {
            return *frame;
        }
    }
    const std::string open = open_frames();
    throw StatusException(
        {StatusCode::ring_full,
         "batches_in_flight is " + std::to_string(frames_.size()) +
             ", and as many are in flight; collect one of them before the next batch" +
             (open.empty() ? ""
                           : ", once frame_completed() says that its frame is complete (" + open +
                                 " are not)")});
}

void BatchRing::release(Frame& frame) {
    shapes_->release(frame.shapes);
    frame.number = 0;
}

queries::FindShape BatchRing::find_shape_for(Frame& frame) {
    return [this, &frame](ShapeHandle shape) { return shapes_->hold(shape, frame.shapes); };
}

void BatchRing::reserve(Frame& frame, const Batch& batch) {
    frame.runner.results().batch = batch.number();
    last_ = nullptr;
    try {
        frame.runner.reserve(batch.queries(), find_shape_for(frame));
    } catch (...) {
        release(frame);
        throw;
    }
    release(frame);
}

/// Checks a query that is in no batch. `any` has to stay; `result` states what is wrong, if it
/// throws.
template <class Query>
queries::CheckedQuery BatchRing::check_alone(AnyQuery& any, AnyResult& result) const {
    const Query& query = std::get<Query>(any);
    const queries::QueryShapes shapes{shapes_->find(query.a.shape), shapes_->find(query.b.shape)};
    choose_techniques({&any, 1}, {&shapes, 1}, planning_.rule);
    queries::CheckedQuery checked;
    if (!queries::check(0, any, shapes, planning_.limits, checked, result)) {
        throw StatusException(std::get<typename Query::Result>(result).status);
    }
    return checked;
}

FieldGrid BatchRing::field_grid(const DistanceFieldQuery& query) const {
    AnyQuery any = query;
    AnyResult result;
    const queries::CheckedQuery checked = check_alone<DistanceFieldQuery>(any, result);
    auto& field = std::get<DistanceFieldResult>(result);
    const std::optional<queries::Grid> grid = queries::grid_of_field(checked, field);
    if (!grid) {
        throw StatusException(field.status);
    }
    if (std::max(grid->width, grid->height) > UINT32_MAX) {
        throw StatusException({StatusCode::too_large, "the field would have " +
                                                          std::to_string(grid->width) + " by " +
                                                          std::to_string(grid->height) + " cells"});
    }
    return {geometry::to_public(grid->origin), grid->cell, static_cast<std::uint32_t>(grid->width),
            static_cast<std::uint32_t>(grid->height)};
}

std::uint64_t BatchRing::target_size(PenetrationQuery query) const {
    query.on_device = true;
    AnyQuery any = query;
    AnyResult result;
    return bytes_of_points(queries::max_points(check_alone<PenetrationQuery>(any, result)));
}

std::uint64_t BatchRing::target_size(ContactQuery query) const {
    query.on_device = true;
    AnyQuery any = query;
    AnyResult result;
    const queries::CheckedQuery checked = check_alone<ContactQuery>(any, result);
    return bytes_of_points(std::ceil(queries::max_points(checked)) +
                           queries::max_samples(*checked.b, checked.budget.cell));
}

std::uint64_t BatchRing::target_size(IntersectionQuery query) const {
    query.on_device = true;
    AnyQuery any = query;
    AnyResult result;
    const queries::CheckedQuery checked = check_alone<IntersectionQuery>(any, result);
    auto& overlap = std::get<IntersectionResult>(result);
    queries::OverlapRegions overlaps;
    if (!overlaps.cover(checked, planning_.limits, overlap)) {
        throw StatusException(overlap.status);
    }
    const double samples = query.samples_on_device ? overlaps.regions().cells() : 0.0;
    return sizeof(IntersectionSummaryData) +
           static_cast<std::uint64_t>(samples) * sizeof(IntersectionSampleData);
}

void BatchRing::trim() noexcept {
    for (const auto& frame : frames_) {
        if (frame->number == 0) {
            frame->runner.trim();
        }
    }
}

template <class Start>
Ticket BatchRing::start_batch(const Batch& batch, Results* memory, Laps& laps, const Start& start) {
    last_ = nullptr;
    Frame& frame = free_frame();
    const double made = frame.runner.pipeline_milliseconds();
    if (memory != nullptr) {
        std::swap(*memory, frame.runner.results());
    }
    frame.runner.results().batch = batch.number();
    frame.runner.time_queries(batch.times_queries());
    try {
        start(frame, find_shape_for(frame));
    } catch (...) {
        release(frame);
        throw;
    }
    frame.number = ++last_number_;
    last_ = &frame;
    frame.runner.results().timings.total =
        laps.total() - (frame.runner.pipeline_milliseconds() - made);
    return {frame.number, shapes_->errors().context()};
}

Ticket BatchRing::submit(const Batch& batch, const Submission& order, Results* memory, Laps& laps) {
    return start_batch(batch, memory, laps,
                       [&](Frame& frame, const queries::FindShape& find_shape) {
                           frame.runner.submit(batch.queries(), find_shape, laps, order);
                       });
}

Ticket BatchRing::submit(const Batch& batch, const Submission& order) {
    Laps laps;
    return submit(batch, order, nullptr, laps);
}

void BatchRing::run(const Batch& batch, Results& results) {
    Laps laps;
    collect(submit(batch, {}, &results, laps), results, laps);
}

void BatchRing::require_open_frame(const Recording& recording) const {
    if (recording.commands == VK_NULL_HANDLE) {
        throw StatusException({StatusCode::invalid_submission, "Recording::commands is null"});
    }
    if (is_complete(recording.frame)) {
        throw StatusException({StatusCode::invalid_submission,
                               "Recording::frame is " + std::to_string(recording.frame) +
                                   ", and frame " + std::to_string(*complete_) +
                                   " and all before it are complete: so the host said by "
                                   "Context::frame_completed()"});
    }
}

Ticket BatchRing::record(const Batch& batch, const Recording& recording) {
    require_open_frame(recording);
    Laps laps;
    return start_batch(
        batch, nullptr, laps, [&](Frame& frame, const queries::FindShape& find_shape) {
            frame.host_frame = recording.frame;
            // Derived from the number that the ticket will have.
            const auto stamp = static_cast<std::uint32_t>((last_number_ + 1) % UINT32_MAX) + 1;
            frame.runner.record(batch.queries(), find_shape, laps, recording.commands, stamp);
        });
}

void BatchRing::complete(std::uint64_t host_frame) {
    if (!is_complete(host_frame)) {
        complete_ = host_frame;
    }
}

std::string BatchRing::open_frames() const {
    std::string names;
    for (const auto& frame : frames_) {
        if (frame->number != 0 &&
            frame->runner.submission_state() == render::SubmissionState::recorded &&
            !is_complete(frame->host_frame)) {
            names += (names.empty() ? "" : ", ") + std::to_string(frame->host_frame);
        }
    }
    return names;
}

bool BatchRing::is_ready(Frame& frame) const {
    return frame.runner.submission_state() == render::SubmissionState::recorded
               ? is_complete(frame.host_frame)
               : frame.runner.is_done();
}

bool BatchRing::is_ready(Ticket ticket) {
    Frame* const frame = find(ticket);
    return frame == nullptr || is_ready(*frame);
}

void BatchRing::collect(Ticket ticket, Results& results) {
    Laps laps;
    if (const Frame* const frame = find(ticket)) {
        expect_answers(frame->runner.device_queries());
    }
    collect(ticket, results, laps);
}

void BatchRing::collect(Ticket ticket, Results& results, Laps& laps) {
    const double begun = laps.total();
    Frame& frame = require(ticket);
    const double made = frame.runner.pipeline_milliseconds();
    if (frame.runner.submission_state() == render::SubmissionState::recorded &&
        !is_complete(frame.host_frame)) {
        throw StatusException(
            {StatusCode::not_ready,
             "the batch was recorded for frame " + std::to_string(frame.host_frame) +
                 ", which is not complete: Context::frame_completed() says when it is"});
    }
    try {
        frame.runner.collect(laps);
    } catch (...) {
        release(frame);
        throw;
    }
    std::swap(results, frame.runner.results());
    release(frame);
    results.timings.total += laps.total() - begun - (frame.runner.pipeline_milliseconds() - made);
}

void BatchRing::list_tiles(std::vector<TileReport>& tiles) const {
    tiles.clear();
    if (last_ != nullptr && last_->runner.device_queries() > 0) {
        last_->runner.list_tiles(tiles);
    }
}

void BatchRing::drop(Ticket ticket) {
    release(require(ticket));
}

void BatchRing::require_none_in_flight(const char* call) const {
    for (const auto& frame : frames_) {
        if (frame->number != 0) {
            throw StatusException(
                {StatusCode::not_ready, std::string(call) + ": the batch of ticket " +
                                            std::to_string(frame->number) +
                                            " is in flight; all have to be collected first"});
        }
    }
}

}  // namespace nearfield::batch
