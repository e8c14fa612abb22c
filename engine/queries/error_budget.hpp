#pragma once

#include <engine/geometry/mesh.hpp>
#include <nearfield/query.hpp>

#include <numbers>

namespace nearfield::queries {

/// Two distances that differ by less than this fraction of d count as equal
/// (PenetratingPoint::unique).
inline constexpr double uniqueness_margin = 1e-3;
/// The same in cells of the grid, whose diagonal is 2 d.
inline constexpr double margin_in_cells = uniqueness_margin / std::numbers::sqrt2;

/// Where the errors of single precision exceed this part of a cell, a search for points leaves to
/// the CPU which of several edges is the nearest.
inline constexpr double search_precision = 1.0 / 16384.0;

/// Relative error of a field's distance due to single precision, for every technique.
inline constexpr double far_rounding = 0x1p-19;

/// How a query spends its tolerance d. Lengths in world units; derivations in docs/error_budget.md.
struct ErrorBudget {
    double tessellation = 0.0;    ///< what the deviations of the shapes add to the bound
    double cell = 0.0;            ///< side of a grid cell
    double simplification = 0.0;  ///< largest distance of simplified chains from the boundary
    double mesh = 0.0;            ///< error of the distance mesh
    double offset = 0.0;          ///< half width of the offset polygon around a boundary
    double bound = 0.0;           ///< the bound that the result states; at most d
};

/// Largest distance of the rings of a query's shapes from the exact shapes, in world units.
struct Deviations {
    double a = 0.0;
    double b = 0.0;
};

[[nodiscard]] ErrorBudget penetration_budget(const PenetrationQuery& query,
                                             const Deviations& deviations = {});
/// For contacts: points of either boundary in the field of the other. The bound consists of the
/// sampling and tessellation errors.
[[nodiscard]] ErrorBudget contact_budget(double tolerance, const Deviations& deviations);
/// For points that only narrow a search: the exact search that follows determines the bound.
[[nodiscard]] ErrorBudget search_budget(double tolerance);
[[nodiscard]] ErrorBudget intersection_budget(const IntersectionQuery& query,
                                              geometry::SubpixelGrid grid,
                                              const Deviations& deviations = {});
[[nodiscard]] ErrorBudget field_budget(const DistanceFieldQuery& query, geometry::SubpixelGrid grid,
                                       const Deviations& deviations = {});

}  // namespace nearfield::queries
