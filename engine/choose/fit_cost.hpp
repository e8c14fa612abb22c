#pragma once

#include <nearfield/cost.hpp>

#include <array>

namespace nearfield::choose {

/// What a workload of one kind comes to, per query, and how long a query of it took by one
/// technique, microseconds, its submission left out.
struct MeasuredWork {
    double edges = 0.0;
    double samples = 0.0;
    double time = 0.0;
};

/// The costs, none of them negative, that come closest to three measurements: of hardly any work,
/// of mostly edges and of mostly samples. Work of a kind without samples has none in all three.
[[nodiscard]] WorkCost fit_cost(const MeasuredWork& least, const MeasuredWork& edges,
                                const MeasuredWork& samples);

}  // namespace nearfield::choose
