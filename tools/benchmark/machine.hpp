#pragma once

#include <string>

namespace nearfield::benchmark {

/// Where a measurement was taken, for later readers of the figures.
struct Machine {
    std::string commit;     ///< of the sources, or their version outside a repository
    std::string processor;  ///< the name the system reports
    unsigned cores = 0;     ///< available to this process
    std::string date;       ///< "2026-11-21"
};

[[nodiscard]] Machine this_machine();

/// The driver of the device with this name; empty if there is none.
[[nodiscard]] std::string driver_of(const std::string& device);

}  // namespace nearfield::benchmark
