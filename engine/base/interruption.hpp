#pragma once

#include <engine/base/status_exception.hpp>
#include <nearfield/limits.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

namespace nearfield {

/// Thrown by a checkpoint once a limit of the call is reached.
class Interrupted : public StatusException {
public:
    using StatusException::StatusException;
};

/// The limits of one call and how far it is. Shared by the jobs of the call.
class Interruption {
public:
    /// Starts the time budget. Throws StatusException (invalid_settings) if it is no time.
    explicit Interruption(const Limits& limits);

    /// True once a limit is reached; it stays so. Counts as a checkpoint until then.
    [[nodiscard]] bool is_due();
    /// Why the call ends. Precondition: is_due() was true.
    [[nodiscard]] Status status() const;

    void expect(std::uint64_t count) { count_.fetch_add(count, std::memory_order_relaxed); }
    void finish(std::uint64_t count) { done_.fetch_add(count, std::memory_order_relaxed); }

private:
    [[nodiscard]] StatusCode reached() const;

    Limits limits_;
    std::optional<std::chrono::steady_clock::time_point> deadline_;
    std::atomic<StatusCode> code_ = StatusCode::ok;
    std::atomic<std::uint64_t> checkpoints_ = 0;
    std::atomic<std::uint64_t> done_ = 0;
    std::atomic<std::uint64_t> count_ = 0;
};

/// Of the call that the thread works for; null if it has no limits. Set by InterruptionScope.
constinit inline thread_local Interruption* current_interruption = nullptr;

/// Makes an interruption, or none (null), that of this thread while the scope lasts.
class InterruptionScope {
public:
    explicit InterruptionScope(Interruption* interruption) : before_(current_interruption) {
        current_interruption = interruption;
    }
    ~InterruptionScope() { current_interruption = before_; }
    InterruptionScope(const InterruptionScope&) = delete;
    InterruptionScope& operator=(const InterruptionScope&) = delete;

private:
    Interruption* before_;
};

/// Throws Interrupted if a limit of the call is reached. What throws must be usable again. Takes
/// about a nanosecond without limits, and a look at the clock with a time budget.
inline void checkpoint() {
    if (current_interruption != nullptr && current_interruption->is_due()) {
        throw Interrupted(current_interruption->status());
    }
}

/// A checkpoint at every `steps`-th step, for loops with short steps.
template <std::uint32_t steps>
class SparseCheckpoint {
public:
    void step() {
        if (++count_ == steps) {
            count_ = 0;
            checkpoint();
        }
    }

private:
    std::uint32_t count_ = 0;
};

/// Adds to what the call has to do, if it has limits.
inline void expect_answers(std::uint64_t count) {
    if (current_interruption != nullptr) {
        current_interruption->expect(count);
    }
}

/// Adds to what the call has done, if it has limits.
inline void finish_answers(std::uint64_t count) {
    if (current_interruption != nullptr) {
        current_interruption->finish(count);
    }
}

}  // namespace nearfield
