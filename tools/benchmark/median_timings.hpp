#pragma once

#include <nearfield/result.hpp>

#include <vector>

namespace nearfield::benchmark {

/// Medians over frames of the same queries, by stage and by pass. Precondition: at least one frame,
/// and every frame has the same passes as the first.
[[nodiscard]] Timings median_timings(const std::vector<Timings>& frames);

}  // namespace nearfield::benchmark
