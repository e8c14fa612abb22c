#pragma once

#include <string>

namespace nearfield::benchmark {

/// Where and of what something is measured, for those who read the figures later.
struct Machine {
    std::string commit;     ///< of the sources, or their version outside a repository
    std::string processor;  ///< its name as the system gives it
    unsigned cores = 0;     ///< that this process may use
    std::string date;       ///< "2026-11-21"
};

[[nodiscard]] Machine this_machine();

/// The driver of the device of this name; empty where it is not found.
[[nodiscard]] std::string driver_of(const std::string& device);

}  // namespace nearfield::benchmark
