// Where a table of pairs that the device finds is recorded into commands of the host.

#include <engine/context/call_within.hpp>
#include <engine/context/device_pair_state.hpp>
#include <engine/context/world_implementation.hpp>

#include <string>

namespace nearfield {

void DevicePairTableBase::State::require_complete_frame(const char* call) const {
    if (!context_->is_complete(*frame_)) {
        throw StatusException(
            {StatusCode::not_ready,
             std::string(call) + ": the table was recorded for frame " + std::to_string(*frame_) +
                 ", which is not complete: Context::frame_completed() says when it is"});
    }
}

/// The device would use what goes with the table.
void DevicePairTableBase::State::report_open_frame() const noexcept {
    if (frame_ && !context_->is_complete(*frame_)) {
        context_->device()->log(LogLevel::error, [&] {
            return "a DevicePairTable is destroyed while what was recorded of it for frame " +
                   std::to_string(*frame_) +
                   " may still run; the device has to finish it, or never begin, and "
                   "Context::frame_completed() says so";
        });
    }
}

bool DevicePairTableBase::State::is_ready() const {
    if (frame_) {
        return context_->is_complete(*frame_);
    }
    return is_submitted_ && (buffers_ == nullptr || buffers_->is_done());
}

void DevicePairTableBase::State::record(Context::Implementation& with, const Source& source,
                                        const Recording& recording) {
    with.ring().begin_frame(recording);
    require_collected("record");
    run_or_start_anew(with, [&] { start("record", with, source, recording.commands); });
    frame_ = recording.frame;
}

/// The commands may be submitted again, so what they use stays whatever happens.
void DevicePairTableBase::State::collect_recorded() {
    if (!is_submitted_) {  // collected before
        timings.plan = timings.record = timings.total = 0.0;
    }
    rows = 0;
    decided_.clear();
    dropped_rows_.clear();
    timings.decode = 0.0;
    for (PassTime& pass : timings.passes) {
        pass.milliseconds = 0.0;
    }
    const Status status = context_->unless_lost([&] { finish(); });
    if (!status.ok()) {
        rows = 0;
        decided_.clear();
        if (buffers_ != nullptr) {
            buffers_->forget_counts();
        }
        set_submitted(false);
        lacks_room_ = status.code() == StatusCode::overflow;
        throw StatusException(status);
    }
}

bool DevicePairTableBase::State::is_recorded(const Context::Implementation& with,
                                             const Source& source) const {
    const render::Renderer* const renderer = with.renderer();
    return frame_ && !lacks_room_ && context_ == &with && world_.lock() == source.identity &&
           instances_.are_those_of(with.shapes(), source.instances) &&
           filters_ == source.instances.filters() && renderer_ == renderer->number();
}

void World::Implementation::record(DevicePairTableBase& table, const DevicePoses* poses,
                                   const Recording& recording) {
    table.state_->record(*context_, {{identity_, instances_}, poses}, read_versioned(recording));
}

bool World::Implementation::is_recorded(const DevicePairTableBase& table) const {
    return table.state_->is_recorded(*context_, {{identity_, instances_}});
}

Status World::record(DevicePairTableBase& table, const Recording& recording, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->record(table, nullptr, recording); });
}

Status World::record(DevicePairTableBase& table, const DevicePoses& poses,
                     const Recording& recording, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->record(table, &poses, recording); });
}

bool World::is_recorded(const DevicePairTableBase& table) const noexcept {
    return implementation_->is_recorded(table);
}

bool DevicePairTableBase::is_ready() const noexcept {
    return state_->is_ready();
}

}  // namespace nearfield
