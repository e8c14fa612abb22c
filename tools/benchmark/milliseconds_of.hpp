#pragma once

#include <chrono>

namespace nearfield::benchmark {

/// How long an action takes.
template <class Action>
[[nodiscard]] double milliseconds_of(const Action& action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

/// The same for an action that may be too short for a clock: it is then repeated.
template <class Action>
[[nodiscard]] double milliseconds_of_short(const Action& action) {
    constexpr double shortest = 1e-3;
    constexpr int repetitions = 100;
    const double once = milliseconds_of(action);
    if (once >= shortest) {
        return once;
    }
    const double together = milliseconds_of([&] {
        for (int i = 0; i < repetitions; ++i) {
            action();
        }
    });
    return together / repetitions;
}

}  // namespace nearfield::benchmark
