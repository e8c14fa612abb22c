#pragma once

#include <engine/geometry/mesh.hpp>
#include <nearfield/query.hpp>

namespace nearfield::plan {

/// Two distances closer than this part of d count as equal (PenetrationRecord::unique).
inline constexpr double uniqueness_margin = 1e-3;

/// What single precision may change of the distance of a field, in parts of it, by any technique.
inline constexpr double far_rounding = 0x1p-19;

/// How a query spends its tolerance d. Lengths in world units; derivations in docs/error_budget.md.
struct ErrorBudget {
    double tessellation = 0.0;    ///< what the deviations of the shapes add to the bound
    double cell = 0.0;            ///< side of a grid cell
    double simplification = 0.0;  ///< how far simplified chains may stray from the boundary
    double mesh = 0.0;            ///< error of the distance mesh
    double offset = 0.0;          ///< half width of the offset polygon around a boundary
    double bound = 0.0;           ///< what the result states; at most d
};

/// How far the rings of a query's shapes may be from the shapes they stand for, world units.
struct Deviations {
    double a = 0.0;
    double b = 0.0;
};

[[nodiscard]] ErrorBudget penetration_budget(const PenetrationQuery& query,
                                             const Deviations& deviations = {});
/// Points of either boundary in the field of the other, for contacts. The bound is the sampling's
/// and the tessellation's.
[[nodiscard]] ErrorBudget contact_budget(double tolerance, const Deviations& deviations);
/// Points that only narrow a search: the bound is left to the one who finishes it exactly.
[[nodiscard]] ErrorBudget search_budget(double tolerance);
[[nodiscard]] ErrorBudget intersection_budget(const IntersectionQuery& query,
                                              geometry::SubpixelGrid grid,
                                              const Deviations& deviations = {});
[[nodiscard]] ErrorBudget field_budget(const DistanceFieldQuery& query, geometry::SubpixelGrid grid,
                                       const Deviations& deviations = {});

}  // namespace nearfield::plan
