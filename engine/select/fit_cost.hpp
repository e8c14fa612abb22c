#pragma once

#include <nearfield/cost.hpp>

namespace nearfield::select {

/// The work of one query of a workload and its measured time by one technique, in microseconds,
/// without the submission.
struct MeasuredWork {
    double edges = 0.0;
    double samples = 0.0;
    double searches = 0.0;
    double shape_edges = 0.0;
    double time = 0.0;
};

/// Of hardly any work, and of mostly edges, samples and searches. Of a kind of work without samples
/// or searches, the measurement of these is not used, and the others have none.
struct Measurements {
    MeasuredWork least;
    MeasuredWork edges;
    MeasuredWork samples;
    MeasuredWork searches;
};

/// Fits non-negative costs to measurements. `shape`: that of an edge of a shape, measured by itself
/// with small shapes; the fitted one is less where many edges take less each.
[[nodiscard]] WorkCost fit_cost(const Measurements& measured, double shape = 0.0);

}  // namespace nearfield::select
