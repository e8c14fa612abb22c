#pragma once

#include <engine/device_input/current_query.hpp>
#include <engine/device_input/point_search.hpp>
#include <engine/geometry/recently_placed.hpp>
#include <nearfield/result.hpp>

#include <cstdint>

namespace nearfield::device_input {

/// Plans queries about points of one boundary in the field of the other, which technique compute
/// leaves to a search of the device.
class SearchPlanner {
public:
    /// Each adds to the plan, and to the result what is known before the search. An error is stated
    /// in the result and leaves the query without a search.
    void plan(const PenetrationQuery& query, CurrentQuery& current, PenetrationResult& result);
    void plan(const ContactQuery& query, CurrentQuery& current, ContactResult& result);

    /// After the last query of a batch.
    void finish(const queries::QueryLimits& limits, Plan& plan) {
        pairs_.fit(limits.largest_range, plan);
    }
    /// Those that the device searches.
    [[nodiscard]] const SearchShapes& shapes() const { return pairs_.shapes(); }

private:
    /// Leaves the points of the query to the device's search, and with `both_ways` those of B as
    /// well: points inside, or up to `reach` outside.
    void search(double reach, bool both_ways, CurrentQuery& current, ResultSummary& result);
    void add_search(std::uint32_t direction, const geometry::TransformedPolygon& a,
                    const geometry::TransformedPolygon& b, Plan& plan);

    geometry::RecentlyPlaced instances_{1024};
    GivenPairsBuilder pairs_;
};

}  // namespace nearfield::device_input
