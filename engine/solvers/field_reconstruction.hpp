#pragma once

#include <engine/queries/field_grid.hpp>
#include <engine/solvers/field_features.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstddef>

/// Reconstructs a field at a point between four cells: low left, low right, high left, high right.
namespace nearfield::solvers {

/// The signed distances at the four cells, in world units, and their sides of the boundary.
struct CellsAround {
    std::array<double, 4> distances{};
    std::array<bool, 4> inside{};
};

/// A cell used by differences at a point, relative to the low left one.
struct CellOffset {
    int column = 0;
    int row = 0;
};
/// The four, then the eight around them, in the order of resolve_field_points.comp.
inline constexpr std::array<CellOffset, 12> difference_cells{{{0, 0},
                                                              {1, 0},
                                                              {0, 1},
                                                              {1, 1},
                                                              {-1, 0},
                                                              {2, 0},
                                                              {-1, 1},
                                                              {2, 1},
                                                              {0, -1},
                                                              {1, -1},
                                                              {0, 2},
                                                              {1, 2}}};

/// The weights of the four cells.
[[nodiscard]] inline std::array<double, 4> bilinear_weights(
    const queries::PlacedFieldPoint& point) {
    return {(1.0 - point.across) * (1.0 - point.up), point.across * (1.0 - point.up),
            (1.0 - point.across) * point.up, point.across * point.up};
}

/// Fills in a point, except for gradients other than analytic ones. `cell_error`: bound on the
/// error of a cell's distance. `nearest`: at the point itself.
void reconstruct(const queries::PlacedFieldPoint& point, const CellsAround& around, double cell,
                 double cell_error, const FieldFeature& nearest, FieldPoint& result);

/// Interpolates the gradients of the four cells, `gradient(i)`, bilinearly.
template <class Gradient>
[[nodiscard]] Vector2 gradient_between(const queries::PlacedFieldPoint& point,
                                       const Gradient& gradient) {
    const std::array<double, 4> weights = bilinear_weights(point);
    geometry::Vector sum = geometry::Vector::Zero();
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i] * gradient(i);
    }
    return geometry::to_public(sum);
}

/// The same for central differences. `value(i)`: the signed distance, in cells, at cell i of
/// difference_cells.
template <class Value>
[[nodiscard]] Vector2 difference_between(const queries::PlacedFieldPoint& point,
                                         const Value& value) {
    // By cell: its neighbours to the left, to the right, below and above.
    constexpr std::array<std::array<std::size_t, 4>, 4> neighbours{
        {{4, 1, 8, 2}, {0, 5, 9, 3}, {6, 3, 0, 10}, {2, 7, 1, 11}}};
    return gradient_between(point, [&](std::size_t i) {
        const auto& [left, right, below, above] = neighbours[i];
        return geometry::Vector((value(right) - value(left)) / 2.0,
                                (value(above) - value(below)) / 2.0);
    });
}

}  // namespace nearfield::solvers
