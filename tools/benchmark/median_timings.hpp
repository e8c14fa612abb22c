#pragma once

#include <nearfield/result.hpp>

#include <vector>

namespace nearfield::benchmark {

/// Medians over frames of the same queries, stage by stage and pass by pass. Precondition: there is
/// a frame, and every frame has the passes of the first.
[[nodiscard]] Timings median_timings(const std::vector<Timings>& frames);

}  // namespace nearfield::benchmark
