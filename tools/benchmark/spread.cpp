#include <tools/benchmark/spread.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::benchmark {
namespace {

/// The quantile of sorted measurements at `share` (0 to 1).
double quantile(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - std::floor(place));
}

}  // namespace

Spread spread_of(std::vector<double> measurements) {
    std::sort(measurements.begin(), measurements.end());
    return {measurements.front(), quantile(measurements, 0.25), quantile(measurements, 0.5),
            quantile(measurements, 0.75), measurements.size()};
}

}  // namespace nearfield::benchmark
