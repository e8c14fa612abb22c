#pragma once

#include <nearfield/cost.hpp>

#include <array>

namespace nearfield::select {

/// The work of one query of a workload and its measured time by one technique, in microseconds,
/// without the submission.
struct MeasuredWork {
    double edges = 0.0;
    double samples = 0.0;
    double time = 0.0;
};

/// Fits non-negative costs to three measurements: of hardly any work, of mostly edges and of mostly
/// samples. For a kind of work without samples, all three have none.
[[nodiscard]] WorkCost fit_cost(const MeasuredWork& least, const MeasuredWork& edges,
                                const MeasuredWork& samples);

}  // namespace nearfield::select
