#pragma once

#include <nearfield/result.hpp>

#include <cstddef>
#include <span>

namespace nearfield::benchmark {

/// Medians over the last `measured` frames of the same queries, by stage and by pass; those before
/// warmed up. Precondition: at least one measured frame, and all have the same passes.
[[nodiscard]] Timings median_timings(std::span<const Timings> frames, std::size_t measured);

/// Milliseconds of all passes together.
[[nodiscard]] double sum_of(std::span<const PassTime> passes);

}  // namespace nearfield::benchmark
