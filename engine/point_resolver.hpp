#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/plan/gpu_layout.hpp>
#include <engine/plan/plan.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <optional>

namespace nearfield {

/// What is known of a point of A and the boundary of B, in double precision.
struct ResolvedPoint {
    geometry::Vector point;
    geometry::Vector nearest;  ///< the point of B's boundary nearest to it
    double distance = 0.0;
    std::uint32_t edge = 0;  ///< of B: an edge that `nearest` lies on
    double parameter = 0.0;  ///< where on it: 0 at its first vertex, 1 at its last
    Feature feature;         ///< of B: where `nearest` lies
    bool inside = false;     ///< inside B, and not just touching its boundary
    bool unique = true;
};

/// A penetrating point as the result has it.
[[nodiscard]] inline PenetrationRecord penetration_record(const ResolvedPoint& resolved) {
    const geometry::Vector way = resolved.nearest - resolved.point;
    return {geometry::to_public(resolved.point),
            resolved.distance,
            geometry::to_public(way / resolved.distance),
            geometry::to_public(resolved.nearest),
            resolved.feature,
            resolved.unique};
}

/// Makes exact what the device said about the points of one query, or of one direction of it.
class PointResolver {
public:
    void begin(const plan::Plan& plan, const plan::PlannedQuery& query);

    /// The point of A that stands at a place of Plan::points; its word as the device wrote it, not
    /// zero.
    [[nodiscard]] ResolvedPoint resolve(const plan::PlannedPoint& planned, std::uint32_t word);

    [[nodiscard]] const geometry::PlacedPolygon& a() const { return *a_; }
    [[nodiscard]] const geometry::PlacedPolygon& b() const { return *b_; }
    /// Questions that the device leaves open.
    [[nodiscard]] exact::Boundary& boundary_of_b();

private:
    const plan::Plan* plan_ = nullptr;
    const plan::PlannedQuery* query_ = nullptr;
    std::optional<geometry::PlacedPolygon> a_;
    std::optional<geometry::PlacedPolygon> b_;
    exact::Boundary boundary_;
    bool boundary_is_set_ = false;
    double rounding_ = 0.0;  // of the points and the boundary; only where no device has its own
};

}  // namespace nearfield
