#pragma once

#include <engine/plan/current_query.hpp>
#include <engine/plan/regions.hpp>
#include <nearfield/result.hpp>

#include <vector>

namespace nearfield::plan {

/// Plans intersections. Reuses its memory from query to query.
class OverlapPlanner {
public:
    /// Adds to the plan, and to the result what is known before rendering. An error is stated in
    /// the result and leaves the query without tiles. Throws StatusException (too_large) if the
    /// batch needs more memory than the limit.
    void plan(const IntersectionQuery& query, CurrentQuery& current, IntersectionResult& result);

private:
    /// Covers everything that two volumes, or a boundary and its neighbourhood, have in common; all
    /// of it lies in `within`.
    void cover_common_volume(const geometry::TransformedPolygon& a,
                             const geometry::TransformedPolygon& b, const geometry::Box& within,
                             CurrentQuery& current, ResultSummary& result);
    void cover_boundary(IntersectionKind kind, const geometry::TransformedPolygon& a,
                        const geometry::TransformedPolygon& b, const geometry::Box& within,
                        CurrentQuery& current, ResultSummary& result);

    std::vector<localize::Chain> chains_;
    Regions regions_;
};

}  // namespace nearfield::plan
