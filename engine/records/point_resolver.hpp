#pragma once

#include <engine/geometry/recently_placed.hpp>
#include <engine/narrowphase/boundary.hpp>
#include <engine/narrowphase/located_points.hpp>
#include <engine/plan/plan.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <nearfield/result.hpp>

#include <shaders/layout.h>

#include <cstdint>
#include <optional>
#include <span>

namespace nearfield::records {

/// A point of A relative to the boundary of B, in double precision.
struct ResolvedPoint {
    geometry::Vector point;
    geometry::Vector nearest;  ///< the point of B's boundary nearest to it
    double distance = 0.0;
    std::uint32_t edge = 0;  ///< of B: an edge that contains `nearest`
    double parameter = 0.0;  ///< position on the edge: 0 at its first vertex, 1 at its last
    Feature feature;         ///< of B: the feature that contains `nearest`
    bool inside = false;     ///< inside B, and not just touching its boundary
    bool unique = true;
};

/// Converts a penetrating point to a record of the result.
[[nodiscard]] inline PenetrationRecord penetration_record(const ResolvedPoint& resolved) {
    const geometry::Vector way = resolved.nearest - resolved.point;
    return {geometry::to_public(resolved.point),
            resolved.distance,
            geometry::to_public(way / resolved.distance),
            geometry::to_public(resolved.nearest),
            resolved.feature,
            resolved.unique};
}

/// How many points penetrate B, and the deepest of them, if any; the first of several.
struct PenetrationSummary {
    std::uint32_t count = 0;
    PenetrationRecord deepest;
};

/// Makes the device's answers for the points of a query, or of one direction of it, exact.
class PointResolver {
public:
    /// `words`: what the device wrote, by point of the plan. Plan and words must stay.
    void begin(const plan::Plan& plan, const plan::PlannedQuery& query,
               std::span<const std::uint32_t> words);

    /// Resolves the point of A at an index of Plan::points, whose word is not zero. Indices must
    /// come in ascending order, and none that is in doubt may be left out.
    [[nodiscard]] ResolvedPoint resolve(std::uint32_t index);

    /// Calls `use(record)` for the points of a penetration query that penetrate B, in their order.
    template <class Use>
    void for_each_penetration(double tolerance, const Use& use) {
        const double touching = tolerance * static_cast<double>(plan::touching_depth);
        for (std::uint32_t i = query_->points().first; i < query_->points().end(); ++i) {
            if ((words_[i] & (plan::point_inside | plan::point_doubtful)) == 0) {
                continue;
            }
            const ResolvedPoint resolved = resolve(i);
            if (resolved.inside && resolved.distance > touching) {
                use(penetration_record(resolved));
            }
        }
    }

    /// What for_each_penetration() tells of points that the device has found, at less cost: it
    /// makes only those exact that may just touch, or may be the deepest.
    [[nodiscard]] PenetrationSummary summarize_penetration(double tolerance);

    [[nodiscard]] const geometry::TransformedPolygon& a() const { return *a_; }
    [[nodiscard]] const geometry::TransformedPolygon& b() const { return *b_; }
    /// For queries that the device leaves open.
    [[nodiscard]] narrowphase::Boundary& boundary_of_b();

private:
    /// What is known of a point: B's nearest point, the side, whether it is the only nearest one.
    struct Found {
        narrowphase::NearestPoint nearest;
        bool inside = false;
        bool unique = true;
    };
    [[nodiscard]] Found find(const geometry::Vector& point, std::uint32_t index);
    [[nodiscard]] Found find_doubtful(std::uint32_t index);
    void locate_doubtful(std::uint32_t first);
    [[nodiscard]] narrowphase::NearestPoint nearest_of_neighbours(const geometry::Vector& point,
                                                                  std::uint32_t edge) const;
    [[nodiscard]] double touching(const plan::PlannedPoint& planned) const;
    [[nodiscard]] bool is_deeper(std::uint32_t index, double depth) const;

    const plan::Plan* plan_ = nullptr;
    const plan::PlannedQuery* query_ = nullptr;
    std::span<const std::uint32_t> words_;
    geometry::RecentlyPlaced recent_{64};
    std::optional<geometry::TransformedPolygon> a_;
    std::optional<geometry::TransformedPolygon> b_;
    std::optional<plan::BoundaryPositions> positions_;  // of points of A
    simd::TransformedInstances instances_;              // B, if it is needed
    narrowphase::Boundary boundary_;
    bool boundary_is_set_ = false;
    simd::PointList points_;  // that the device left in doubt, some of them
    narrowphase::LocatedPoints located_;
    std::uint32_t next_ = 0;  // of those
    double rounding_ = 0.0;   // of the points and the boundary; only for queries on the CPU
};

}  // namespace nearfield::records
