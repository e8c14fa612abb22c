#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <stdexcept>
#include <vector>

namespace nearfield::bench {

/// Processor time, which other load does not count in: by default that of this thread only.
/// Throws std::runtime_error if there is no such clock.
inline double processor_milliseconds(clockid_t of = CLOCK_THREAD_CPUTIME_ID) {
    timespec now{};
    if (clock_gettime(of, &now) != 0) {
        throw std::runtime_error("no processor time");
    }
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

inline double wall_milliseconds() {
    return std::chrono::duration<double, std::milli>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Of an even number the greater of the two in the middle. Precondition: there is one.
inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace nearfield::bench
