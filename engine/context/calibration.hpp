#pragma once

#include <nearfield/context.hpp>
#include <nearfield/cost.hpp>

#include <functional>

namespace nearfield {

/// Measures what each technique costs in a context, by running each on a few synthetic workloads.
/// Adds shapes to the context and removes them again. Techniques that the context does not have
/// keep the context's costs. `progress`, if any, receives the completed fraction, up to 1. Throws
/// StatusException if a workload is rejected.
[[nodiscard]] CostModel calibrate(Context& context, const DeviceTechniques& techniques,
                                  const std::function<void(double)>& progress);

}  // namespace nearfield
