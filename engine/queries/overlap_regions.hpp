#pragma once

#include <engine/queries/checked_query.hpp>
#include <engine/queries/regions.hpp>
#include <nearfield/result.hpp>

#include <vector>

namespace nearfield::queries {

/// The regions of an intersection: where both shapes may have a sample in common. Reuses its memory
/// from query to query.
class OverlapRegions {
public:
    /// Finds the regions of a query, and states them in the result. Returns false, and states the
    /// error, if the tolerance is too small for the deviations or the coordinates.
    [[nodiscard]] bool cover(const CheckedQuery& query, const QueryLimits& limits,
                             IntersectionResult& result);

    [[nodiscard]] const Regions& regions() const { return regions_; }
    /// Host memory for an intersection in these regions, without bit masks.
    [[nodiscard]] double bytes_of_samples(const IntersectionQuery& query,
                                          double largest_tile) const;

private:
    /// Covers everything that two volumes, or a boundary and its neighbourhood, have in common; all
    /// of it lies in `within`.
    void cover_common_volume(const geometry::TransformedPolygon& a,
                             const geometry::TransformedPolygon& b, const geometry::Box& within,
                             const geometry::OverlapOptions& options, IntersectionResult& result);
    void cover_boundary(const geometry::TransformedPolygon& a,
                        const geometry::TransformedPolygon& b, const geometry::Box& within,
                        geometry::OverlapOptions options, IntersectionResult& result);

    std::vector<geometry::Chain> chains_;
    Regions regions_;
};

}  // namespace nearfield::queries
