#include <engine/geometry/offset_mesh.hpp>
#include <engine/plan/error_budget.hpp>

#include <algorithm>
#include <numbers>

namespace nearfield::plan {
namespace {

// Coordinates inside a tile are floats below 2^11 cells: what rounding they suffer, in cells, with
// room for the few operations of a distance.
constexpr double float_rounding = 1.0 / 1024.0;

// Error of the distance mesh, in cells. Where resolve walks the original edges, errors of the mesh
// and of simplification cost it work but no accuracy, so both are coarse there.
constexpr double points_mesh_error = 0.5;
constexpr double field_mesh_error = 0.125;

}  // namespace

ErrorBudget penetration_budget(const PenetrationQuery& query) {
    const double d = query.tolerance;
    ErrorBudget budget = search_budget(d);
    // Depth changes by no more than the way along the boundary, and samples are at most a cell
    // apart on it; vertices are all looked at.
    const double sampling = query.points == PenetrationPoints::boundary ? budget.cell / 2.0 : 0.0;
    budget.bound = sampling + float_rounding * d;
    return budget;
}

ErrorBudget contact_budget(double tolerance) {
    ErrorBudget budget = search_budget(tolerance);
    // As for penetration: distances change by no more than the way along the boundary.
    budget.bound = budget.cell / 2.0 + float_rounding * tolerance;
    return budget;
}

ErrorBudget search_budget(double tolerance) {
    ErrorBudget budget;
    budget.cell = tolerance * std::numbers::sqrt2;
    budget.simplification = tolerance;
    budget.mesh = points_mesh_error * budget.cell;
    return budget;
}

ErrorBudget intersection_budget(const IntersectionQuery& query, geometry::SubpixelGrid grid) {
    const double d = query.tolerance;
    ErrorBudget budget;
    budget.simplification = d / 16.0;
    // The snapping of the raster in units of half a cell's diagonal.
    const double snapping = grid.largest_move() * std::numbers::sqrt2;
    double half_diagonal = 0.0;
    if (query.kind == IntersectionKind::volume_volume) {
        half_diagonal = (d - budget.simplification) / (1.0 + snapping);
    } else {
        // overreach * (half_diagonal + simplification) + 3 snapping + simplification = d
        const double overreach = geometry::offset_overreach;
        half_diagonal =
            (d - (1.0 + overreach) * budget.simplification) / (overreach + 3.0 * snapping);
    }
    budget.cell = half_diagonal * std::numbers::sqrt2;
    budget.offset = half_diagonal + budget.simplification;
    budget.bound = d;
    return budget;
}

ErrorBudget field_budget(const DistanceFieldQuery& query, geometry::SubpixelGrid grid) {
    const double d = query.tolerance;
    ErrorBudget budget;
    budget.cell = d * std::numbers::sqrt2;
    // A distance mesh cannot be finer than the raster's snapping lets it be.
    budget.mesh = std::max(field_mesh_error, 10.0 * grid.largest_move()) * budget.cell;
    // The sample itself is a cell's centre, so there is no sampling error: what is left is the
    // simplified boundary, a feature that won although another is nearer by up to the error of the
    // mesh, the raster's snapping of that mesh and of the fill, and rounding.
    const double rest = budget.mesh + (2.0 * grid.largest_move() + float_rounding) * budget.cell;
    budget.simplification = std::min(d / 4.0, 0.9 * (d - rest));
    budget.bound = budget.simplification + rest;
    return budget;
}

}  // namespace nearfield::plan
