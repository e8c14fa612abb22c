#include <engine/failure.hpp>
#include <engine/frame_ring.hpp>
#include <engine/stopwatch.hpp>

#include <string>
#include <utility>

namespace nearfield {

FrameRing::FrameRing(std::uint32_t frames, const plan::PlanLimits& limits, const CostModel& costs,
                     const char* gradient_format, Renderer& renderer, ShapeStore& shapes)
    : shapes_(&shapes), planning_(limits, costs), normals_(planning_, gradient_format, renderer) {
    for (std::uint32_t i = 0; i < frames; ++i) {
        frames_.push_back(std::make_unique<Frame>(
            Frame{BatchRunner(planning_, gradient_format, renderer), {}, 0}));
    }
}

FrameRing::Frame* FrameRing::find(Ticket ticket) {
    for (const auto& frame : frames_) {
        if (ticket.number != 0 && frame->number == ticket.number) {
            return frame.get();
        }
    }
    return nullptr;
}

FrameRing::Frame& FrameRing::require(Ticket ticket) {
    Frame* const frame = find(ticket);
    if (frame == nullptr) {
        throw Failure({StatusCode::unknown_ticket, "no batch of this context has the ticket " +
                                                       std::to_string(ticket.number) +
                                                       ", or it was collected already"});
    }
    return *frame;
}

FrameRing::Frame& FrameRing::free_frame() {
    for (const auto& frame : frames_) {
        if (frame->number == 0) {
            return *frame;
        }
    }
    throw Failure({StatusCode::ring_full, "all " + std::to_string(frames_.size()) +
                                              " frames are in flight; collect one of them before "
                                              "the next batch is submitted"});
}

void FrameRing::release(Frame& frame) {
    shapes_->release(frame.shapes);
    frame.number = 0;
}

Ticket FrameRing::submit(std::span<const AnyQuery> queries, Results* memory) {
    const Stopwatch start;
    Frame& frame = free_frame();
    if (memory != nullptr) {
        std::swap(*memory, frame.runner.results());
    }
    try {
        frame.runner.submit(queries, [this, &frame](ShapeHandle shape) {
            return shapes_->hold(shape, frame.shapes);
        });
    } catch (...) {
        release(frame);
        throw;
    }
    frame.number = ++last_number_;
    frame.runner.results().timings.total = start.milliseconds();
    return {frame.number};
}

bool FrameRing::is_ready(Ticket ticket) {
    Frame* const frame = find(ticket);
    return frame == nullptr || frame->runner.is_done();
}

void FrameRing::collect(Ticket ticket, Results& results) {
    const Stopwatch start;
    Frame& frame = require(ticket);
    try {
        frame.runner.collect();
        normals_.apply(frame.runner);
    } catch (...) {
        release(frame);
        throw;
    }
    std::swap(results, frame.runner.results());
    release(frame);
    results.timings.total += start.milliseconds();
}

void FrameRing::drop(Ticket ticket) {
    release(require(ticket));
}

}  // namespace nearfield
