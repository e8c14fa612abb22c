#include <engine/device_input/search_planner.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/grid.hpp>

#include <cmath>

namespace nearfield::device_input {
namespace {

using geometry::Box;
using geometry::BoxedPolygon;
using geometry::grown;
using geometry::TransformedPolygon;

/// Whether the device can search boundaries with so many points.
bool is_searchable(double samples, const CurrentQuery& current) {
    const PlannedQuery& planned = current.planned();
    return samples <= queries::max_searched_points &&
           queries::max_shape_bytes(*planned.a, *planned.b) <= current.limits.largest_range;
}

/// Checks that the device can search what is to stay there; the result states the error.
bool check_resident(bool both_ways, const CurrentQuery& current, ResultSummary& result) {
    const PlannedQuery& planned = current.planned();
    if (!planned.on_device) {
        return true;
    }
    const double samples =
        queries::max_points(planned) +
        (both_ways ? queries::max_samples(*planned.b, planned.budget.cell) : 0.0);
    if (is_searchable(samples, current)) {
        return true;
    }
    result.status = {StatusCode::too_large,
                     "of records that are to stay on the device (on_device), it searches " +
                         geometry::number(queries::max_searched_points) + " points and shapes of " +
                         geometry::number(static_cast<double>(current.limits.largest_range)) +
                         " bytes; these boundaries may have " +
                         geometry::number(std::ceil(samples)) + " points, and their shapes take " +
                         geometry::number(static_cast<double>(
                             queries::max_shape_bytes(*planned.a, *planned.b))) +
                         " bytes"};
    return false;
}

}  // namespace

void SearchPlanner::plan(const PenetrationQuery& query, CurrentQuery& current,
                         PenetrationResult& result) {
    // Of points that are only counted the device leaves out those that cannot be the deepest.
    current.planned().work.emplace<PlannedPoints>().summarized = query.summary_only;
    search(0.0, false, current, result);
}

void SearchPlanner::plan(const ContactQuery& query, CurrentQuery& current, ContactResult& result) {
    current.planned().work.emplace<PlannedPoints>().outside = true;
    search(query.contact_distance, true, current, result);
}

void SearchPlanner::add_search(std::uint32_t direction, const TransformedPolygon& a,
                               const TransformedPolygon& b, Plan& plan) {
    PlannedQuery& planned = plan.queries[direction];
    const geometry::Vector axis = b.rotation().transpose() * a.rotation().col(0);
    planned.points().margin =
        pairs_.add(direction, planned, axis, b.to_local(a.translation()), plan.pairs);
}

void SearchPlanner::search(double reach, bool both_ways, CurrentQuery& current,
                           ResultSummary& result) {
    PlannedQuery& planned = current.planned();
    planned.points().source = PointSource::device;
    const BoxedPolygon a = instances_.place(*planned.a, planned.pose_a);
    const BoxedPolygon b = instances_.place(*planned.b, planned.pose_b);
    if (!check_resident(both_ways, current, result) || !check_numbers(planned, a, b, result)) {
        return;
    }
    const Box of_a = a.box.intersection(grown(b.box, reach));
    const Box of_b = b.box.intersection(grown(a.box, reach));
    const bool are_near = !of_a.isEmpty() && !of_b.isEmpty();
    // What stays on the device says there that there is nothing.
    const bool is_searched = are_near || planned.on_device;
    if (are_near) {
        const Box where = both_ways ? of_a.merged(of_b) : of_a;
        result.regions.push_back(
            queries::region_of(queries::Grid::covering(where, planned.budget.cell)));
    }
    if (is_searched) {
        add_search(current.index, a.placed, b.placed, current.plan);
    }
    if (both_ways) {
        const std::uint32_t reverse = add_reverse(current);
        if (is_searched) {
            add_search(reverse, b.placed, a.placed, current.plan);
        }
    }
}

}  // namespace nearfield::device_input
