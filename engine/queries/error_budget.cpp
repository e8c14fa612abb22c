#include <engine/geometry/offset_mesh.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/queries/field_parts.hpp>

#include <algorithm>
#include <numbers>

namespace nearfield::queries {
namespace {

// Bound, in cells, on the rounding error of coordinates inside a tile, which are floats below 2^11
// cells; includes the few operations of a distance.
constexpr double float_rounding = 1.0 / 1024.0;

// Error of the distance mesh, in cells. Where the resolve pass walks the original edges, errors of
// the mesh and of simplification cost time but no accuracy, so both are coarse there.
constexpr double points_mesh_error = 0.5;
constexpr double field_mesh_error = 0.125;

}  // namespace

ErrorBudget penetration_budget(const PenetrationQuery& query, const Deviations& deviations) {
    const double d = query.tolerance;
    ErrorBudget budget = search_budget(d);
    // Depth changes by at most the distance moved along the boundary, on which samples are at most
    // a cell apart; vertices are all evaluated.
    const double sampling = query.points == PenetrationPoints::boundary ? budget.cell / 2.0 : 0.0;
    // Relative to the exact shapes, a boundary point lies off A's rings and its depth off B's.
    budget.tessellation = deviations.a + deviations.b;
    budget.bound = sampling + float_rounding * d + budget.tessellation;
    return budget;
}

ErrorBudget contact_budget(double tolerance, const Deviations& deviations) {
    ErrorBudget budget = search_budget(tolerance);
    // As for penetration: distances change by at most the distance moved along the boundary.
    budget.tessellation = deviations.a + deviations.b;
    budget.bound = budget.cell / 2.0 + float_rounding * tolerance + budget.tessellation;
    return budget;
}

ErrorBudget search_budget(double tolerance) {
    ErrorBudget budget;
    budget.cell = tolerance * std::numbers::sqrt2;
    budget.simplification = tolerance;
    budget.mesh = points_mesh_error * budget.cell;
    return budget;
}

ErrorBudget intersection_budget(const IntersectionQuery& query, geometry::SubpixelGrid grid,
                                const Deviations& deviations) {
    const double d = query.tolerance;
    ErrorBudget budget;
    budget.simplification = d / 16.0;
    budget.tessellation = std::max(deviations.a, deviations.b);
    const double left = d - budget.tessellation;
    // The raster's snapping in units of half a cell's diagonal.
    const double snapping = grid.largest_move() * std::numbers::sqrt2;
    double half_diagonal = 0.0;
    if (query.kind == IntersectionKind::volume_volume) {
        half_diagonal = (left - budget.simplification) / (1.0 + snapping);
    } else {
        // The offset must reach the exact curves, from which the rings may deviate: overreach *
        // (half_diagonal + simplification + tessellation) + 3 snapping + simplification +
        // tessellation = d
        const double overreach = geometry::offset_overreach;
        half_diagonal = (left - overreach * (budget.simplification + budget.tessellation) -
                         budget.simplification) /
                        (overreach + 3.0 * snapping);
    }
    budget.cell = half_diagonal * std::numbers::sqrt2;
    budget.offset = half_diagonal + budget.simplification + budget.tessellation;
    budget.bound = d;
    return budget;
}

ErrorBudget field_budget(const DistanceFieldQuery& query, geometry::SubpixelGrid grid,
                         const Deviations& deviations) {
    const double d = query.tolerance;
    ErrorBudget budget;
    budget.cell = d * std::numbers::sqrt2;
    if (query.technique == Technique::cpu) {
        // No mesh and no snapping. Features are those of the original shape, and so are points.
        const FieldParts parts = field_parts(query);
        budget.tessellation = deviations.b;
        budget.simplification = parts.values && !parts.features ? d / 4.0 : 0.0;
        budget.bound = budget.simplification + float_rounding * d + budget.tessellation;
        return budget;
    }
    // A distance mesh cannot be finer than the raster's snapping allows.
    budget.mesh = std::max(field_mesh_error, 10.0 * grid.largest_move()) * budget.cell;
    // The sample is a cell's centre, so there is no sampling error. What remains: the simplified
    // boundary; a feature that won although another is nearer by up to the error of the mesh; the
    // raster's snapping of that mesh and of the fill; rounding.
    const double rest = budget.mesh + (2.0 * grid.largest_move() + float_rounding) * budget.cell;
    budget.tessellation = deviations.b;
    const double left = d - rest - budget.tessellation;
    budget.simplification = std::clamp(0.9 * left, 0.0, d / 4.0);
    budget.bound = budget.simplification + rest + budget.tessellation;
    return budget;
}

}  // namespace nearfield::queries
