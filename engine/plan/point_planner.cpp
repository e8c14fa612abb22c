#include <engine/geometry/magnitude.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/placed_pair.hpp>
#include <engine/plan/point_planner.hpp>
#include <engine/plan/point_search.hpp>
#include <engine/plan/region.hpp>
#include <engine/plan/search_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace nearfield::plan {
namespace {

using geometry::Box;
using geometry::BoxedPolygon;
using geometry::grown;
using geometry::TransformedPolygon;
using localize::Chain;

// Host memory per point: planned and resolved, in the result and in the buffers on the way there.
constexpr double bytes_per_point =
    sizeof(PlannedPoint) + std::max(sizeof(PenetratingPoint), sizeof(ContactPoint)) + 64.0;
// For either boundary, in a search that is finished exactly.
constexpr double max_search_samples = 4096.0;

/// Checks that deviations and coordinates are compatible with the tolerance; the result states the
/// error.
bool check_numbers(const PlannedQuery& planned, const BoxedPolygon& a, const BoxedPolygon& b,
                   ResultSummary& result) {
    result.status = check_deviations(result.tolerance, planned.deviations, planned.budget.bound);
    if (result.status.ok()) {
        result.status = check_resolution(
            result.tolerance,
            std::max(geometry::largest_magnitude(a.placed, planned.pose_a, a.box),
                     geometry::largest_magnitude(b.placed, planned.pose_b, b.box)));
    }
    return result.status.ok();
}

bool check_numbers(const PlannedQuery& planned, ResultSummary& result) {
    return check_numbers(planned, BoxedPolygon(*planned.a, planned.pose_a),
                         BoxedPolygon(*planned.b, planned.pose_b), result);
}

/// Adds the other direction of the query: points of B in the field of A.
std::uint32_t add_reverse(CurrentQuery& current) {
    PlannedQuery reverse = current.planned();
    std::swap(reverse.a, reverse.b);
    std::swap(reverse.pose_a, reverse.pose_b);
    std::swap(reverse.deviations.a, reverse.deviations.b);
    const auto index = static_cast<std::uint32_t>(current.plan.queries.size());
    current.planned().points().reverse = index;
    current.plan.queries.push_back(reverse);
    return index;
}

/// Whether the device can search boundaries with so many points.
bool is_searchable(double samples, const CurrentQuery& current) {
    const PlannedQuery& planned = current.planned();
    return samples <= max_searched_points &&
           max_shape_bytes(*planned.a, *planned.b) <= current.limits.largest_range;
}

/// Checks that the device can search what is to stay there; the result states the error.
bool check_resident(bool both_ways, const CurrentQuery& current, ResultSummary& result) {
    const PlannedQuery& planned = current.planned();
    if (!planned.on_device) {
        return true;
    }
    const double samples =
        max_points(planned) + (both_ways ? max_samples(*planned.b, planned.budget.cell) : 0.0);
    if (is_searchable(samples, current)) {
        return true;
    }
    result.status = {StatusCode::too_large,
                     "of records that are to stay on the device (on_device), it searches " +
                         number(max_searched_points) + " points and shapes of " +
                         number(static_cast<double>(current.limits.largest_range)) +
                         " bytes; these boundaries may have " + number(std::ceil(samples)) +
                         " points, and their shapes take " +
                         number(static_cast<double>(max_shape_bytes(*planned.a, *planned.b))) +
                         " bytes"};
    return false;
}

/// Finds the chains of A that can penetrate; returns an upper bound on the points asked for.
double find_inside(const PenetrationQuery& query, CurrentQuery& current, std::vector<Chain>& chains,
                   ResultSummary& result) {
    const PlannedQuery& planned = current.planned();
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    find_chains(current.plan, result, chains, [&] {
        return localize::chains_in_volume(a, b, current.overlap_options(0.0), chains);
    });
    return query.points == PenetrationPoints::vertices
               ? max_vertices(chains)
               : max_samples(a, chains, result.cell, b.box());
}

/// Finds the chains of A that can hold contacts; returns an upper bound on their samples.
double find_near(const TransformedPolygon& a, const TransformedPolygon& b, double contact_distance,
                 const CurrentQuery& current, std::vector<Chain>& chains, ResultSummary& result) {
    find_chains(current.plan, result, chains, [&] {
        return localize::chains_near_boundary(a, b, current.overlap_options(contact_distance),
                                              chains);
    });
    return max_samples(a, chains, result.cell, grown(b.box(), contact_distance));
}

}  // namespace

PointPlanner::PointPlanner(const PlanLimits& limits)
    : tiles_(std::min(limits.points_tile, limits.largest_tile)) {}

void PointPlanner::add_search(std::uint32_t direction, const TransformedPolygon& a,
                              const TransformedPolygon& b, Plan& plan) {
    PlannedQuery& planned = plan.queries[direction];
    const geometry::Vector axis = b.rotation().transpose() * a.rotation().col(0);
    planned.points().margin =
        pairs_.add(direction, planned, axis, b.to_local(a.translation()), plan.pairs);
}

void PointPlanner::search(double reach, bool both_ways, CurrentQuery& current,
                          ResultSummary& result) {
    PlannedQuery& planned = current.planned();
    planned.points().source = PointSource::device;
    const BoxedPolygon a = instances_.place_with_box(*planned.a, planned.pose_a);
    const BoxedPolygon b = instances_.place_with_box(*planned.b, planned.pose_b);
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
        result.regions.push_back(region_of(Grid::covering(where, planned.budget.cell)));
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

void PointPlanner::add_samples(std::uint32_t direction, const Box& within, CurrentQuery& current) {
    Plan& plan = current.plan;
    PlannedQuery& planned = plan.queries[direction];
    const TransformedPolygon a(*planned.a, planned.pose_a);
    PlannedPoints& points = planned.points();
    points.first = static_cast<std::uint32_t>(plan.points.size());
    tiles_.spread(a, samples_, within, regions_.boxes(), regions_.grids(), direction, plan);
    points.count = static_cast<std::uint32_t>(plan.points.size()) - points.first;
}

void PointPlanner::plan(const PenetrationQuery& query, CurrentQuery& current,
                        PenetrationResult& result) {
    PlannedQuery& planned = current.planned();
    auto& points = planned.work.emplace<PlannedPoints>();
    if (planned.technique == Technique::compute) {
        // Of points that are only counted the device leaves out those that cannot be the deepest.
        points.summarized = query.summary_only;
        search(0.0, false, current, result);
        return;
    }
    if (!check_numbers(planned, result)) {
        return;
    }
    const double samples = find_inside(query, current, chains_[0], result);
    if (!chains_[0].empty()) {
        add_deepest(query, samples, current, result);
    }
}

void PointPlanner::add_deepest(const PenetrationQuery& query, double samples, CurrentQuery& current,
                               PenetrationResult& result) {
    const PlannedQuery& planned = current.planned();
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const Box box_b = TransformedPolygon(*planned.b, planned.pose_b).box();
    current.memory.require(bytes_per_point * samples, 1.0);
    samples_.clear();
    if (query.points == PenetrationPoints::vertices) {
        vertices_of_chains(a, chains_[0], samples_);
    } else {
        sample_chains(a, chains_[0], result.cell, box_b, samples_);
    }
    regions_.cover(chains_[0], 0.0, box_b, result);
    add_samples(current.index, box_b, current);
}

void PointPlanner::plan(const ContactQuery& query, CurrentQuery& current, ContactResult& result) {
    PlannedQuery& planned = current.planned();
    auto& points = planned.work.emplace<PlannedPoints>();
    points.outside = true;
    if (query.normals == ContactNormals::gradient) {
        current.plan.with_gradient_normals.push_back(current.index);
    }
    const double near = query.contact_distance;
    if (planned.technique == Technique::compute) {
        search(near, true, current, result);
        return;
    }
    if (!check_numbers(planned, result)) {
        return;
    }
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const double of_a = find_near(a, b, near, current, chains_[0], result);
    const double of_b = find_near(b, a, near, current, chains_[1], result);
    const std::uint32_t reverse = add_reverse(current);
    add_near(current.index, near, chains_[0], of_a, current, result);
    add_near(reverse, near, chains_[1], of_b, current, result);
}

void PointPlanner::add_near(std::uint32_t direction, double contact_distance,
                            const std::vector<Chain>& chains, double samples, CurrentQuery& current,
                            ResultSummary& result) {
    if (chains.empty()) {
        return;
    }
    const PlannedQuery& planned = current.plan.queries[direction];
    const Box within =
        grown(TransformedPolygon(*planned.b, planned.pose_b).box(), contact_distance);
    regions_.cover(chains, 0.0, within, result);
    current.memory.require(bytes_per_point * samples, 1.0);
    samples_.clear();
    sample_chains(TransformedPolygon(*planned.a, planned.pose_a), chains, result.cell, within,
                  samples_);
    add_samples(direction, within, current);
}

void PointPlanner::plan(const ClosestPointQuery& /*query*/, CurrentQuery& current,
                        ClosestPointResult& result) {
    plan_closest(false, current, result);
}

void PointPlanner::plan(const SeparationQuery& /*query*/, CurrentQuery& current,
                        SeparationResult& result) {
    plan_closest(true, current, result);
}

void PointPlanner::plan_closest(bool both_ways, CurrentQuery& current, ResultSummary& result) {
    PlannedQuery& planned = current.planned();
    planned.work.emplace<PlannedPoints>().outside = true;
    result.cell = planned.budget.cell;
    if (!check_numbers(planned, result)) {
        return;
    }
    tested_.clear();
    result.intersects = intersect(planned, tested_, overlap_test_);
    if (result.intersects) {
        return;  // at distance 0: nothing to render
    }
    const std::uint32_t reverse = both_ways ? add_reverse(current) : PlannedPoints::none;
    double samples = find_closest(current.index, current, chains_[0], result);
    if (both_ways) {
        samples = std::max(samples, find_closest(reverse, current, chains_[1], result));
    }
    // The exact search continues wherever the samples end, so more samples gain nothing.
    result.cell *= std::max(1.0, samples / max_search_samples);
    if (both_ways) {
        add_closest(reverse, chains_[1], current, result);
    }
    add_closest(current.index, chains_[0], current, result);
}

double PointPlanner::find_closest(std::uint32_t direction, const CurrentQuery& current,
                                  std::vector<Chain>& chains, ResultSummary& result) {
    const PlannedQuery& planned = current.plan.queries[direction];
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    find_chains(current.plan, result, chains,
                [&] { return closest_.find(a, b, current.overlap_options(0.0), chains); });
    return max_samples(a, chains, result.cell, grown(a.box(), result.cell));
}

void PointPlanner::add_closest(std::uint32_t direction, const std::vector<Chain>& chains,
                               CurrentQuery& current, ResultSummary& result) {
    PlannedQuery& planned = current.plan.queries[direction];
    planned.budget = search_budget(result.cell / std::numbers::sqrt2);
    const TransformedPolygon a(*planned.a, planned.pose_a);
    // A box slightly larger than A, so that rounding drops no point.
    const Box everything = grown(a.box(), result.cell);
    regions_.cover(chains, 0.0, everything, result);
    const double samples = max_samples(a, chains, result.cell, everything);
    current.memory.require(bytes_per_point * samples, 1.0);
    samples_.clear();
    sample_chains(a, chains, result.cell, everything, samples_);
    // A short chain may lie between two samples.
    for (const Chain& chain : chains) {
        samples_.push_back({chain.first, 0.0});
    }
    add_samples(direction, everything, current);
}

}  // namespace nearfield::plan
