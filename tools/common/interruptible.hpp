#pragma once

#include <nearfield/limits.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <thread>

namespace nearfield::tools {

/// From now on, Ctrl-C (SIGINT) sets a flag instead of ending the program.
void catch_ctrl_c();

/// True once Ctrl-C was pressed, after catch_ctrl_c().
[[nodiscard]] bool was_ctrl_c_pressed() noexcept;

/// Throws LibraryError (cancelled) once Ctrl-C was pressed.
void stop_after_ctrl_c();

/// Calls of the library that Ctrl-C cancels. If the standard error is a terminal, it shows how many
/// queries are answered while they take more than a second.
class InterruptibleCalls {
public:
    /// `name`: what is counted, in the plural.
    explicit InterruptibleCalls(const char* name);
    /// Clears the line on the terminal.
    ~InterruptibleCalls();
    InterruptibleCalls(const InterruptibleCalls&) = delete;
    InterruptibleCalls& operator=(const InterruptibleCalls&) = delete;

    /// For each of the calls, one after the other.
    [[nodiscard]] const Limits& limits() const noexcept { return limits_; }

private:
    void show_until_done();

    const char* name_;
    Limits limits_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::atomic<std::uint64_t> done_ = 0;
    std::atomic<std::uint64_t> count_ = 0;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool is_over_ = false;
    std::thread thread_;  // only with a terminal
};

/// A line on the standard error, if that is a terminal, about what is being done; the end clears
/// it.
class StatusLine {
public:
    StatusLine();
    ~StatusLine() { show({}); }
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;

    void show(std::string_view text) const;
    /// "row 3 of 50: NAME", or "frame 3 of 50" without a name.
    void show(std::string_view what, std::uint64_t number, std::uint64_t count,
              std::string_view name = {}) const;

private:
    bool is_shown_;
};

}  // namespace nearfield::tools
