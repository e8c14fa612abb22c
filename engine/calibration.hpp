#pragma once

#include <nearfield/context.hpp>
#include <nearfield/cost.hpp>

#include <functional>

namespace nearfield {

/// What the techniques cost in a context, found by running each on a few made-up workloads. Adds
/// shapes to the context and removes them again. Techniques that the context does not have keep the
/// context's costs. `progress`, if any, is told the part that is done, up to 1. Throws Failure
/// where a workload is refused.
[[nodiscard]] CostModel measure_costs(Context& context, const DeviceTechniques& techniques,
                                      const std::function<void(double)>& progress);

}  // namespace nearfield
