#pragma once

#include <nearfield/timings.hpp>

#include <tests/support/fake_loader.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::bench {

/// What was recorded of a pass: counted on the way to the driver.
struct PassCalls {
    std::uint32_t dispatches = 0;
    std::uint32_t barriers = 0;
    std::uint64_t workgroups = 0;
    std::uint64_t items = 0;    ///< of dispatches whose size the device has counted
    double megabytes = 0.0;     ///< of the buffer ranges that are bound
    double microseconds = 0.0;  ///< of the processor, until it was recorded
};

/// Adds the entry points that count. A pass is what two timestamps enclose; a host needs them on.
void count_passes(test_support::Lies& lies);

/// Of all passes recorded since the last reset of timestamps, in order. Call once the device is
/// done: the sizes of indirect dispatches are read from its memory.
[[nodiscard]] std::vector<PassCalls> recorded_passes();

/// Prints a row per pass, in Markdown. `times`: of the passes with these names.
void print_passes(const char* scene, std::span<const PassCalls> passes,
                  std::span<const PassTime> times);
inline constexpr const char* head_of_passes =
    "\n| scene | pass | dispatches | workgroups | items | barriers | MB bound | recorded, µs | "
    "device, ms |\n|---|---|---|---|---|---|---|---|---|\n";

}  // namespace nearfield::bench
