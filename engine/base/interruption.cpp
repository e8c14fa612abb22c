#include <engine/base/interruption.hpp>

#include <array>
#include <charconv>
#include <string>

namespace nearfield {
namespace {

using Clock = std::chrono::steady_clock;

// A century: longer than any call, and far from where the clock's count overflows.
constexpr double no_end = 3e9;

std::string text_of(double seconds) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), seconds).ptr;
    return {text.data(), end};
}

}  // namespace

Interruption::Interruption(const Limits& limits) : limits_(limits) {
    if (!(limits.seconds >= 0.0)) {
        throw StatusException(
            {StatusCode::invalid_settings,
             "Limits::seconds is " + text_of(limits.seconds) + "; it must be at least 0"});
    }
    if (limits.seconds < no_end) {
        deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(limits.seconds));
    }
}

StatusCode Interruption::reached() const {
    if (limits_.cancel != nullptr && limits_.cancel->load(std::memory_order_relaxed)) {
        return StatusCode::cancelled;
    }
    return deadline_ && Clock::now() >= *deadline_ ? StatusCode::budget_exhausted : StatusCode::ok;
}

bool Interruption::is_due() {
    if (code_.load(std::memory_order_relaxed) != StatusCode::ok) {
        return true;
    }
    const std::uint64_t number = checkpoints_.fetch_add(1, std::memory_order_relaxed) + 1;
    if (limits_.progress != nullptr) {
        limits_.progress(limits_.user, {number, done_.load(std::memory_order_relaxed),
                                        count_.load(std::memory_order_relaxed)});
    }
    const StatusCode code = reached();
    if (code == StatusCode::ok) {
        return false;
    }
    StatusCode none = StatusCode::ok;
    code_.compare_exchange_strong(none, code, std::memory_order_relaxed);  // the first one counts
    return true;
}

Status Interruption::status() const {
    const StatusCode code = code_.load(std::memory_order_relaxed);
    return {code, code == StatusCode::cancelled
                      ? "the call was cancelled (Limits::cancel) before this was answered"
                      : "the call's budget of " + text_of(limits_.seconds) +
                            " s (Limits::seconds) was used up before this was answered"};
}

}  // namespace nearfield
