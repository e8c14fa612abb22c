#pragma once

#include <cstddef>
#include <vector>

namespace nearfield::benchmark {

/// Where a list of measurements lies.
struct Spread {
    double least = 0.0;
    double lower_quartile = 0.0;
    double median = 0.0;
    double upper_quartile = 0.0;
    std::size_t count = 0;
};

/// Quartiles between two measurements are interpolated. Precondition: there is one measurement.
[[nodiscard]] Spread spread_of(std::vector<double> measurements);

}  // namespace nearfield::benchmark
