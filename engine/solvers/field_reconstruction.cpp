#include <engine/solvers/field_reconstruction.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::solvers {
namespace {

/// Bounds the error of a reconstructed distance. The true distance differs from each cell's by at
/// most the distance to that cell plus the cell's own error, so it lies between two limits.
double reconstruction_error(const std::array<double, 4>& values, double distance, double cell_error,
                            const queries::PlacedFieldPoint& point, double cell) {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t right = i % 2;
        const std::size_t above = i / 2;
        const double x = point.across - static_cast<double>(right);
        const double y = point.up - static_cast<double>(above);
        const double reach = cell * std::sqrt(x * x + y * y) + cell_error;
        low = std::max(low, values[i] - reach);
        high = std::min(high, values[i] + reach);
    }
    return std::max(high - distance, distance - low);
}

}  // namespace

void reconstruct(const queries::PlacedFieldPoint& point, const CellsAround& around, double cell,
                 double cell_error, const FieldFeature& nearest, FieldPoint& result) {
    const std::array<double, 4> weights = bilinear_weights(point);
    result.position = geometry::to_public(point.position);
    result.distance = 0.0;
    result.inside = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        result.distance += weights[i] * around.distances[i];
        result.inside += around.inside[i] ? weights[i] : 0.0;
    }
    result.error_bound =
        reconstruction_error(around.distances, result.distance, cell_error, point, cell);
    result.feature = nearest.feature;
    result.unique = nearest.unique;
    result.gradient = geometry::to_public(nearest.gradient);
}

}  // namespace nearfield::solvers
