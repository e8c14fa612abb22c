#include <engine/select/fit_cost.hpp>

#include <algorithm>

namespace nearfield::select {

WorkCost fit_cost(const Measurements& measured) {
    // Gauss-Seidel: each measurement is dominated by one of the numbers, so this converges, and it
    // clamps to 0 any number that noise would make negative.
    constexpr int iterations = 100;
    WorkCost cost;
    const auto fit = [&](double WorkCost::*part, const MeasuredWork& by, double amount) {
        if (amount > 0.0) {
            cost.*part = 0.0;
            const double others = cost.query + cost.edge * by.edges + cost.sample * by.samples +
                                  cost.search * by.searches;
            cost.*part = std::max(0.0, by.time - others) / amount;
        }
    };
    for (int i = 0; i < iterations; ++i) {
        fit(&WorkCost::query, measured.least, 1.0);
        fit(&WorkCost::edge, measured.edges, measured.edges.edges);
        fit(&WorkCost::sample, measured.samples, measured.samples.samples);
        fit(&WorkCost::search, measured.searches, measured.searches.searches);
    }
    return cost;
}

}  // namespace nearfield::select
