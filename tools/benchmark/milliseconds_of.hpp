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

}  // namespace nearfield::benchmark
