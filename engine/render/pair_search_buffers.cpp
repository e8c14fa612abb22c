#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/render/pair_search_buffers.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::render {
PairSearchBuffers::PairSearchBuffers(const gpu::Device& device, const graph::ComputeLayout& layout,
                                     const passes::PairSearch& passes,
                                     const device_input::PairQuestion& question,
                                     const PairTableCounts& reserve, bool timestamps)
    : device_(&device),
      submission_(device),
      timestamps_(device, 0, timestamps),
      poses_(device, layout),
      outputs_(device, layout),
      world_(device),
      memory_(device, layout, passes, question.kind(), reserve, question.on_device) {}

PairSearchBuffers::~PairSearchBuffers() {
    if (is_submitted_) {
        submission_.wait_to_the_end();
    }
}

PairLimits PairSearchBuffers::limits() const {
    return {.reach = device_->limits().maxStorageBufferRange, .memory = memory_limit_};
}

SearchInput PairSearchBuffers::input() const {
    return {world_.shape_part(), world_.instance_part(), world_.count()};
}

void PairSearchBuffers::lay_out() {
    memory_.lay_out(input(), limits());
    laid_out_world_ = world_.revision();
    is_laid_out_ = true;
}

/// Lets the commands that follow be about the present memory, and about where poses come from and
/// results go. Whatever can fail is done here, before anything is recorded.
void PairSearchBuffers::prepare(bool takes_poses, std::uint32_t pairs) {
    checkpoint();
    if (!is_laid_out_) {
        is_bound_ = false;
        lay_out();
    }
    memory_.clear_counts(pairs);
    const std::uint32_t revision = takes_poses ? poses_.revision() : 0;
    if (!is_bound_ || bound_poses_ != revision || bound_outputs_ != outputs_.revision()) {
        is_bound_ = is_recorded_ = false;
        bind_ends(takes_poses);
        bound_poses_ = revision;
        bound_outputs_ = outputs_.revision();
        is_bound_ = true;
    }
}

/// Where poses come from, and where results go.
void PairSearchBuffers::bind_ends(bool takes_poses) {
    if (takes_poses) {
        poses_.bind(input());
    }
    if (outputs_.is_set()) {
        outputs_.bind(input(), memory_);
    }
    timestamps_.reserve(static_cast<std::uint32_t>(poses_.count_passes() + memory_.count_passes() +
                                                   outputs_.count_passes(memory_.parts())));
}

void PairSearchBuffers::write_commands(VkCommandBuffer commands, bool takes_poses) {
    timestamps_.reset(commands);
    if (takes_poses) {
        poses_.record(commands, timestamps_);
    }
    memory_.record_boxes(commands, timestamps_);
    for (std::size_t i = 0; i < memory_.parts(); ++i) {
        memory_.record(i, commands, timestamps_);
        if (outputs_.is_set()) {
            outputs_.record(i, memory_.part(i).input(), commands, timestamps_);
        }
    }
    outputs_.record_headers(commands, timestamps_);
}

/// The commands stay the same as long as the memory does, and where poses come from and results go.
void PairSearchBuffers::submit(bool takes_poses, Timings& timings) {
    const Stopwatch start;
    prepare(takes_poses, 0);
    if (is_recorded_) {
        submission_.submit_again();
    } else {
        write_commands(submission_.begin(true), takes_poses);
        submission_.submit();
    }
    is_submitted_ = is_recorded_ = true;
    timings.record += start.milliseconds();
}

/// Whether the device has executed the commands that were recorded for the host.
bool PairSearchBuffers::were_executed() const {
    const auto counts_of_parts = memory_.counts();
    return std::none_of(counts_of_parts.begin(), counts_of_parts.end(), [](const auto& counts) {
        return counts[shaders::pair_total] == not_counted;
    });
}

/// What there was room for.
void PairSearchBuffers::read_results() {
    if (poses_.is_set()) {
        poses_.finish();
    }
    memory_.read_results();
    has_results_ = true;
}

/// Makes room for what the device has counted.
void PairSearchBuffers::grow(double headroom) {
    memory_.grow(headroom);
    is_laid_out_ = false;
}

void PairSearchBuffers::upload(const device_input::SearchShapes& shapes, std::uint64_t memory_limit,
                               double headroom) {
    memory_limit_ = memory_limit;
    const bool had_results = std::exchange(has_results_, false);
    const bool was_for_host = std::exchange(is_for_host_, false);
    if (was_for_host) {
        memory_.read_counts();
    }
    const bool is_known = was_for_host ? were_executed() : had_results;
    if (is_known && !memory_.had_room(headroom)) {
        grow(headroom);
    }
    if (had_results && memory_.capacities().join(limits())) {
        is_laid_out_ = false;
    }
    world_.upload(shapes);
    if (memory_.capacities().set_instances(world_.count()) ||
        laid_out_world_ != world_.revision()) {
        is_laid_out_ = false;
    }
}

void PairSearchBuffers::begin(const device_input::SearchShapes& shapes, std::uint64_t memory_limit,
                              Timings& timings) {
    upload(shapes, memory_limit, 1.0);
    submit(poses_.is_set(), timings);
}

void PairSearchBuffers::finish(Timings& timings) {
    for (;;) {
        const Stopwatch waiting;
        submission_.wait();
        is_submitted_ = false;
        memory_.read_counts();
        timings.device += waiting.milliseconds();
        timestamps_.collect(timings.passes);
        if (memory_.had_room()) {
            break;
        }
        grow(1.0);
        // The places that the poses gave are still there; the host may have overwritten the poses.
        submit(false, timings);
    }
    read_results();
}

void PairSearchBuffers::record(VkCommandBuffer commands, const device_input::SearchShapes& shapes,
                               std::uint64_t memory_limit, double headroom, Timings& timings) {
    upload(shapes, memory_limit, headroom);
    const Stopwatch start;
    prepare(poses_.is_set(), not_counted);
    device_->begin_label(commands, "nearfield");
    write_commands(commands, poses_.is_set());
    device_->end_label(commands);
    is_for_host_ = true;
    timings.record += start.milliseconds();
}

void PairSearchBuffers::require_room_of_target() const {
    const PairTableCounts found = memory_.last_found();
    PairTableCounts room = found;
    outputs_.limit(room);
    if (room == found) {
        return;
    }
    const auto reason = [](const char* what, std::uint32_t count, std::uint32_t fits,
                           std::uint64_t bytes) {
        return std::to_string(count) + ' ' + what + ", and room for " + std::to_string(fits) +
               "; a buffer of " + std::to_string(count * bytes) + " bytes has room for as many";
    };
    std::vector<std::string> reasons;
    if (found.rows > room.rows) {
        reasons.push_back(reason("pairs", found.rows, room.rows, sizeof(PairData)));
    }
    if (found.points > room.points) {
        reasons.push_back(reason("points", found.points, room.points, sizeof(PointData)));
    }
    throw StatusException({StatusCode::overflow,
                           "the table has all its rows, and the target has room for fewer",
                           std::move(reasons)});
}

PairTableCounts PairSearchBuffers::found() const {
    return is_submitted_ ? PairTableCounts{} : memory_.found();
}

void PairSearchBuffers::collect(Timings& timings) {
    memory_.read_counts();
    if (!were_executed()) {
        throw StatusException(
            {StatusCode::not_executed,
             "the frame of this table counts as complete, but the device did not execute the "
             "commands recorded for it; was the command buffer submitted?"});
    }
    timestamps_.collect(timings.passes);
    memory_.require_room();
    read_results();
}

}  // namespace nearfield::render
