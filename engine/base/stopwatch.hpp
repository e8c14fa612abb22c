#pragma once

#include <chrono>

namespace nearfield {

/// Measures wall-clock time from its construction.
class Stopwatch {
public:
    [[nodiscard]] double milliseconds() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Measures consecutive parts of a time from its construction, with one reading of the clock for
/// each: a reading takes 20 nanoseconds, as long as small queries do.
class Laps {
public:
    /// Ends a part; returns its length in milliseconds.
    double next() {
        const double before = total_;
        total_ = watch_.milliseconds();
        return total_ - before;
    }
    /// Milliseconds from the construction to the end of the last part.
    [[nodiscard]] double total() const { return total_; }

private:
    Stopwatch watch_;
    double total_ = 0.0;
};

}  // namespace nearfield
