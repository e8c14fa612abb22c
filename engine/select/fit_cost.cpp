#include <engine/select/fit_cost.hpp>

#include <algorithm>

namespace nearfield::select {

WorkCost fit_cost(const Measurements& measured, double shape) {
    // Gauss-Seidel: each measurement is dominated by one of the numbers, so this converges, and it
    // clamps to 0 any number that noise would make negative.
    constexpr int iterations = 100;
    WorkCost cost{.shape = shape};
    const auto fit = [&](double WorkCost::*part, const MeasuredWork& by, double amount) {
        if (amount > 0.0) {
            cost.*part = 0.0;
            const double others = cost.query + cost.edge * by.edges + cost.sample * by.samples +
                                  cost.search * by.searches + cost.shape * by.shape_edges;
            cost.*part = std::max(0.0, by.time - others) / amount;
        }
    };
    const auto fit_edges = [&] {
        cost.edge = 0.0;
        fit(&WorkCost::shape, measured.edges, measured.edges.shape_edges);
        cost.shape = std::min(cost.shape, shape);
        fit(&WorkCost::edge, measured.edges, measured.edges.edges);
    };
    for (int i = 0; i < iterations; ++i) {
        fit(&WorkCost::query, measured.least, 1.0);
        fit_edges();
        fit(&WorkCost::sample, measured.samples, measured.samples.samples);
        fit(&WorkCost::search, measured.searches, measured.searches.searches);
    }
    return cost;
}

}  // namespace nearfield::select
