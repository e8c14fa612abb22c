#pragma once

#include <engine/geometry/recently_placed.hpp>
#include <engine/localize/closest.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/plan/current_query.hpp>
#include <engine/plan/point_search.hpp>
#include <engine/plan/point_tiles.hpp>
#include <engine/plan/regions.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Plans queries about points of one boundary in the field of the other. Which points, is decided
/// by a search of the device, or by localisation and samples here. Reuses its memory from query to
/// query.
class PointPlanner {
public:
    explicit PointPlanner(const PlanLimits& limits);

    /// Each adds to the plan, and to the result what is known before rendering. An error is stated
    /// in the result and leaves the query without tiles. Throws StatusException (too_large) if the
    /// batch needs more memory than the limit.
    void plan(const PenetrationQuery& query, CurrentQuery& current, PenetrationResult& result);
    void plan(const ContactQuery& query, CurrentQuery& current, ContactResult& result);
    void plan(const ClosestPointQuery& query, CurrentQuery& current, ClosestPointResult& result);
    void plan(const SeparationQuery& query, CurrentQuery& current, SeparationResult& result);

    /// After the last query of a batch.
    void finish(const PlanLimits& limits, Plan& plan) { pairs_.fit(limits.largest_range, plan); }
    /// Those that the device searches.
    [[nodiscard]] const SearchShapes& search_shapes() const { return pairs_.shapes(); }

private:
    /// Leaves the points of the query to the device's search, and with `both_ways` those of B as
    /// well: points inside, or up to `reach` outside.
    void search(double reach, bool both_ways, CurrentQuery& current, ResultSummary& result);
    void add_search(std::uint32_t direction, const geometry::TransformedPolygon& a,
                    const geometry::TransformedPolygon& b, Plan& plan);
    /// Samples the chains of A; `samples` is an upper bound on their number.
    void add_deepest(const PenetrationQuery& query, double samples, CurrentQuery& current,
                     PenetrationResult& result);
    void add_near(std::uint32_t direction, double contact_distance,
                  const std::vector<localize::Chain>& chains, double samples, CurrentQuery& current,
                  ResultSummary& result);
    void plan_closest(bool both_ways, CurrentQuery& current, ResultSummary& result);
    /// Finds the chains that can hold the closest point; returns an upper bound on their samples.
    [[nodiscard]] double find_closest(std::uint32_t direction, const CurrentQuery& current,
                                      std::vector<localize::Chain>& chains, ResultSummary& result);
    void add_closest(std::uint32_t direction, const std::vector<localize::Chain>& chains,
                     CurrentQuery& current, ResultSummary& result);
    /// Adds those of the samples that lie in `within`, and the tiles or regions that hold them.
    void add_samples(std::uint32_t direction, const geometry::Box& within, CurrentQuery& current);

    geometry::RecentlyPlaced instances_{1024};  // whose points the device searches
    simd::TransformedInstances tested_;
    narrowphase::OverlapTest overlap_test_;
    GivenPairsBuilder pairs_;
    localize::ClosestChains closest_;
    std::array<std::vector<localize::Chain>, 2> chains_;  // A and B
    Regions regions_;
    std::vector<BoundaryPoint> samples_;
    PointTiles tiles_;
};

}  // namespace nearfield::plan
