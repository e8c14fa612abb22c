#include <engine/select/fit_cost.hpp>

#include <algorithm>

namespace nearfield::select {

WorkCost fit_cost(const MeasuredWork& least, const MeasuredWork& edges,
                  const MeasuredWork& samples) {
    // Gauss-Seidel: each measurement is dominated by one of the three numbers, so this converges,
    // and it clamps to 0 any number that noise would make negative.
    constexpr int iterations = 50;
    WorkCost cost;
    for (int i = 0; i < iterations; ++i) {
        cost.query =
            std::max(0.0, least.time - cost.edge * least.edges - cost.sample * least.samples);
        cost.edge =
            std::max(0.0, edges.time - cost.query - cost.sample * edges.samples) / edges.edges;
        if (samples.samples > 0.0) {
            cost.sample = std::max(0.0, samples.time - cost.query - cost.edge * samples.edges) /
                          samples.samples;
        }
    }
    return cost;
}

}  // namespace nearfield::select
