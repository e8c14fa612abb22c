#pragma once

#include <cstddef>
#include <vector>

namespace nearfield::benchmark {

/// The distribution of a list of measurements.
struct Spread {
    double least = 0.0;
    double lower_quartile = 0.0;
    double median = 0.0;
    double upper_quartile = 0.0;
    std::size_t count = 0;
};

/// Quartiles are interpolated between measurements. Precondition: the list is not empty.
[[nodiscard]] Spread spread_of(std::vector<double> measurements);

}  // namespace nearfield::benchmark
