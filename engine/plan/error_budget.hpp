#pragma once

#include <engine/geometry/mesh.hpp>
#include <nearfield/query.hpp>

namespace nearfield::plan {

/// Two distances closer than this part of d count as equal (PenetrationRecord::unique).
inline constexpr double uniqueness_margin = 1e-3;

/// How a query spends its tolerance d. Lengths in world units; derivations in docs/error_budget.md.
struct ErrorBudget {
    double cell = 0.0;            ///< side of a grid cell
    double simplification = 0.0;  ///< how far simplified chains may stray from the boundary
    double mesh = 0.0;            ///< error of the distance mesh
    double offset = 0.0;          ///< half width of the offset polygon around a boundary
    double bound = 0.0;           ///< what the result states; at most d
};

[[nodiscard]] ErrorBudget penetration_budget(const PenetrationQuery& query);
/// Points of either boundary in the field of the other, for contacts. The bound is the sampling's.
[[nodiscard]] ErrorBudget contact_budget(double tolerance);
/// Points that only narrow a search: the bound is left to the one who finishes it exactly.
[[nodiscard]] ErrorBudget search_budget(double tolerance);
[[nodiscard]] ErrorBudget intersection_budget(const IntersectionQuery& query,
                                              geometry::SubpixelGrid grid);
[[nodiscard]] ErrorBudget field_budget(const DistanceFieldQuery& query,
                                       geometry::SubpixelGrid grid);

}  // namespace nearfield::plan
