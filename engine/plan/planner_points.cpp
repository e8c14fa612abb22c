#include <engine/base/stopwatch.hpp>
#include <engine/geometry/magnitude.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/planner.hpp>
#include <engine/plan/point_search.hpp>
#include <engine/plan/region.hpp>

#include <algorithm>
#include <numbers>
#include <utility>

namespace nearfield::plan {

// The part of the planner for points of one boundary in the field of the other.

using geometry::Box;
using geometry::grown;
using geometry::TransformedPolygon;

namespace {

// Host memory per point: planned and resolved, in the result and in the buffers on the way there.
constexpr double bytes_per_point =
    sizeof(PlannedPoint) + std::max(sizeof(PenetrationRecord), sizeof(ContactRecord)) + 64.0;

// The same for a resident point: its details, its table entry, its record.
constexpr double bytes_per_resident_point = 16.0 + 16.0 + 40.0;

double bytes_of_point(const PlannedQuery& query) {
    return bytes_per_point + (query.resident ? bytes_per_resident_point : 0.0);
}

// For either boundary, in a search that is finished exactly.
constexpr double max_search_samples = 4096.0;

// For a whole boundary: keeps the numbers of samples, and of the parts of an edge, well within 32
// bits.
constexpr double max_numbered_samples = 1U << 30U;

SearchedQuery searched_query(std::uint32_t query, const TransformedPolygon& a,
                             const TransformedPolygon& b) {
    return {query, b.rotation().transpose() * a.rotation().col(0), b.to_local(a.translation())};
}

}  // namespace

bool Planner::check_numbers(ResultSummary& result) const {
    const PlannedQuery& planned = plan_->queries[query_];
    return check_numbers(BoxedPolygon(*planned.a, planned.pose_a),
                         BoxedPolygon(*planned.b, planned.pose_b), result);
}

bool Planner::check_numbers(const BoxedPolygon& a, const BoxedPolygon& b,
                            ResultSummary& result) const {
    const PlannedQuery& planned = plan_->queries[query_];
    result.status = check_deviations(result.tolerance, planned.deviations, planned.budget.bound);
    if (result.status.ok()) {
        result.status = check_resolution(
            result.tolerance,
            std::max(geometry::largest_magnitude(a.placed, planned.pose_a, a.box),
                     geometry::largest_magnitude(b.placed, planned.pose_b, b.box)));
    }
    return result.status.ok();
}

bool Planner::can_keep(double samples) {
    if (samples > max_to_keep_) {
        return false;
    }
    max_kept_ = std::max(max_kept_, samples);
    return true;
}

bool Planner::fits_roughly(double samples, double bytes_of_record) {
    const bool is_to_be_close = counts_closely_ && bytes_of_record > 0.0;
    if (is_to_be_close || !can_keep(samples)) {
        return false;
    }
    rough_bytes_ += bytes_of_record * samples;
    return true;
}

bool Planner::fits(double samples, double bytes_of_record, double tolerance) {
    if (!can_keep(samples)) {
        return false;
    }
    require_memory(bytes_of_record * samples, tolerance, 1.0);
    return true;
}

/// Returns whether the device may search for the points of the query. Resident outputs still need
/// planned points.
bool Planner::can_be_searched(double samples, double bytes_of_record) {
    const PlannedQuery& planned = plan_->queries[query_];
    constexpr double bytes_of_found = sizeof(PlannedPoint) + sizeof(std::uint32_t);
    return planned.by_compute && !planned.resident && samples <= max_searched_points &&
           fits_roughly(samples, bytes_of_found + bytes_of_record);
}

/// Leaves the points of the query to the device, and with `both_ways` those of B as well: points
/// inside, or up to `reach` outside.
void Planner::search(double reach, bool both_ways, ResultSummary& result) {
    PlannedQuery& planned = plan_->queries[query_];
    const BoxedPolygon a(*planned.a, planned.pose_a);
    const BoxedPolygon b(*planned.b, planned.pose_b);
    if (!check_numbers(a, b, result)) {
        return;
    }
    planned.searched = true;
    const Box of_a = a.box.intersection(grown(b.box, reach));
    const Box of_b = b.box.intersection(grown(a.box, reach));
    const bool are_near = !of_a.isEmpty() && !of_b.isEmpty();
    if (are_near) {
        const Box where = both_ways ? of_a.merged(of_b) : of_a;
        result.regions.push_back(region_of(Grid::covering(where, planned.budget.cell)));
        plan_->searched.push_back(searched_query(query_, a.placed, b.placed));
    }
    if (both_ways) {
        const std::uint32_t reverse = add_reverse();
        if (are_near) {
            plan_->searched.push_back(searched_query(reverse, b.placed, a.placed));
        }
    }
}

void Planner::add(const PenetrationQuery& query, PenetrationResult& result) {
    PlannedQuery& planned = plan_->queries[query_];
    const ErrorBudget budget = penetration_budget(query, planned.deviations);
    result.error_bound = budget.bound;
    result.cell = budget.cell;
    const bool vertices = query.points == PenetrationPoints::vertices;
    const double bytes_of_record = query.records ? sizeof(PenetrationRecord) : 0.0;
    const double of_boundary =
        vertices ? static_cast<double>(planned.a->size()) : max_samples(*planned.a, budget.cell);
    const bool may_be_by_edge = planned.on_cpu && of_boundary <= max_numbered_samples;
    planned.brute_force = may_be_by_edge && fits_roughly(of_boundary, bytes_of_record);
    if (planned.brute_force) {
        // Nothing is planned: only the bound of the budget is used.
        planned.budget.bound = budget.bound;
        planned.budget.cell = budget.cell;
        return;
    }
    planned.budget = budget;
    if (can_be_searched(of_boundary, bytes_of_record)) {
        search(0.0, false, result);
        return;
    }
    if (!check_numbers(result)) {
        return;
    }
    const TransformedPolygon a(*planned.a, query.a.pose);
    const TransformedPolygon b(*planned.b, query.b.pose);

    const Stopwatch start;
    const Box box_b = b.box();
    chains_.clear();
    count(localize::chains_in_volume(a, b, overlap_options(0.0), chains_), result);
    localize_milliseconds_ += start.milliseconds();
    if (chains_.empty()) {
        return;
    }
    const double samples =
        vertices ? max_vertices(chains_) : max_samples(a, chains_, result.cell, box_b);
    planned.brute_force = may_be_by_edge && fits(samples, bytes_of_record, query.tolerance);
    if (planned.brute_force) {
        return;
    }
    join_chain_boxes(box_b, 0.0);
    if (vertices) {
        samples_.clear();
        require_memory(bytes_of_point(planned) * samples, query.tolerance, 1.0);
        vertices_of_chains(a, chains_, samples_);
    } else {
        sample_boundary(a, box_b, samples, result);
    }
    const std::size_t first_tile = plan_->tiles.size();
    spread_points(query_, box_b, result);
    check_resident(query.target, first_tile, result);
}

void Planner::check_resident(const ResidentBufferTarget* target, std::size_t first_tile,
                             ResultSummary& result) {
    PlannedQuery& planned = plan_->queries[query_];
    if (!planned.resident || target == nullptr) {
        return;
    }
    PlannedQuery* const reverse =
        planned.reverse == PlannedQuery::none ? nullptr : &plan_->queries[planned.reverse];
    const double points =
        1.0 * planned.point_count + (reverse == nullptr ? 0.0 : 1.0 * reverse->point_count);
    result.status =
        check_room(*target, sizeof(SummaryData) + points * sizeof(RecordData), "records");
    if (result.status.ok()) {
        return;
    }
    plan_->tiles.resize(first_tile);
    plan_->points.resize(plan_->points.size() - static_cast<std::size_t>(points));
    planned.point_count = 0;
    if (reverse != nullptr) {
        reverse->point_count = 0;
    }
}

std::uint32_t Planner::add_reverse() {
    PlannedQuery reverse = plan_->queries[query_];
    std::swap(reverse.a, reverse.b);
    std::swap(reverse.pose_a, reverse.pose_b);
    std::swap(reverse.deviations.a, reverse.deviations.b);
    const auto index = static_cast<std::uint32_t>(plan_->queries.size());
    plan_->queries[query_].reverse = index;
    plan_->queries.push_back(reverse);
    return index;
}

void Planner::sample_boundary(const TransformedPolygon& polygon, const Box& within, double samples,
                              const ResultSummary& result) {
    require_memory(bytes_of_point(plan_->queries[query_]) * samples, result.tolerance, 1.0);
    samples_.clear();
    sample_chains(polygon, chains_, result.cell, within, samples_);
}

void Planner::spread_points(std::uint32_t index, const Box& within, ResultSummary& result) {
    PlannedQuery& planned = plan_->queries[index];
    const TransformedPolygon a(*planned.a, planned.pose_a);
    planned.first_point = static_cast<std::uint32_t>(plan_->points.size());
    add_regions(result.cell, result);
    if (planned.on_cpu) {
        for (const BoundaryPoint& sample : samples_) {
            if (within.contains(position(a, sample))) {
                plan_->points.push_back({sample, PlannedPoint::no_tile});
            }
        }
    } else {
        point_tiles_.spread(a, samples_, within, boxes_, grids_, index, *plan_);
    }
    planned.point_count = static_cast<std::uint32_t>(plan_->points.size()) - planned.first_point;
}

double Planner::find_contact_chains(const TransformedPolygon& a, const TransformedPolygon& b,
                                    double contact_distance, std::vector<localize::Chain>& chains,
                                    ResultSummary& result) {
    const Stopwatch start;
    chains_.clear();
    count(localize::chains_near_boundary(a, b, overlap_options(contact_distance), chains_), result);
    localize_milliseconds_ += start.milliseconds();
    chains.assign(chains_.begin(), chains_.end());
    return max_samples(a, chains, result.cell, grown(b.box(), contact_distance));
}

void Planner::add_contact_points(std::uint32_t index, double contact_distance,
                                 const std::vector<localize::Chain>& chains, double samples,
                                 ResultSummary& result) {
    const PlannedQuery& planned = plan_->queries[index];
    const Box within =
        grown(TransformedPolygon(*planned.b, planned.pose_b).box(), contact_distance);
    chains_.assign(chains.begin(), chains.end());
    join_chain_boxes(within, 0.0);
    if (!chains_.empty()) {
        sample_boundary(TransformedPolygon(*planned.a, planned.pose_a), within, samples, result);
        spread_points(index, within, result);
    }
}

void Planner::add(const ContactQuery& query, ContactResult& result) {
    PlannedQuery& planned = plan_->queries[query_];
    planned.budget = contact_budget(query.tolerance, planned.deviations);
    planned.outside = true;
    result.error_bound = planned.budget.bound;
    result.cell = planned.budget.cell;
    const bool gradients = query.normals == ContactNormals::gradient;
    if (gradients) {
        plan_->with_gradient_normals.push_back(query_);
    }
    const double of_boundaries =
        max_samples(*planned.a, result.cell) + max_samples(*planned.b, result.cell);
    // Gradients are computed around planned points.
    const bool may_be_by_edge =
        planned.on_cpu && !gradients && of_boundaries <= max_numbered_samples;
    const double bytes_of_record = query.records ? sizeof(ContactRecord) : 0.0;
    planned.brute_force = may_be_by_edge && fits_roughly(of_boundaries, bytes_of_record);
    if (planned.brute_force) {
        return;
    }
    if (!gradients && can_be_searched(of_boundaries, bytes_of_record)) {
        search(query.contact_distance, true, result);
        return;
    }
    if (!check_numbers(result)) {
        return;
    }
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const double near = query.contact_distance;
    const double of_a = find_contact_chains(a, b, near, chains_of_[0], result);
    const double of_b = find_contact_chains(b, a, near, chains_of_[1], result);
    planned.brute_force = may_be_by_edge && fits(of_a + of_b, bytes_of_record, query.tolerance);
    if (planned.brute_force) {
        return;
    }
    const std::uint32_t reverse = add_reverse();
    const std::size_t first_tile = plan_->tiles.size();
    add_contact_points(query_, near, chains_of_[0], of_a, result);
    add_contact_points(reverse, near, chains_of_[1], of_b, result);
    check_resident(query.target, first_tile, result);
}

double Planner::find_closest_chains(std::uint32_t index, std::vector<localize::Chain>& chains,
                                    ResultSummary& result) {
    const PlannedQuery& planned = plan_->queries[index];
    const TransformedPolygon a(*planned.a, planned.pose_a);
    const TransformedPolygon b(*planned.b, planned.pose_b);
    const Stopwatch start;
    chains_.clear();
    count(closest_.find(a, b, overlap_options(0.0), chains_), result);
    localize_milliseconds_ += start.milliseconds();
    chains.assign(chains_.begin(), chains_.end());
    return max_samples(a, chains, result.cell, grown(a.box(), result.cell));
}

void Planner::add_closest_points(std::uint32_t index, const std::vector<localize::Chain>& chains,
                                 ResultSummary& result) {
    PlannedQuery& planned = plan_->queries[index];
    planned.budget = search_budget(result.cell / std::numbers::sqrt2);
    const TransformedPolygon a(*planned.a, planned.pose_a);
    // A box slightly larger than A, so that rounding drops no point.
    const Box everything = grown(a.box(), result.cell);
    chains_.assign(chains.begin(), chains.end());
    join_chain_boxes(everything, 0.0);
    sample_boundary(a, everything, max_samples(a, chains_, result.cell, everything), result);
    // A short chain may lie between two samples.
    for (const localize::Chain& chain : chains_) {
        samples_.push_back({chain.first, 0.0});
    }
    spread_points(index, everything, result);
}

void Planner::add(const ClosestPointQuery& query, ClosestPointResult& result) {
    add_closest(query.tolerance, false, result);
}

void Planner::add(const SeparationQuery& query, SeparationResult& result) {
    add_closest(query.tolerance, true, result);
}

void Planner::add_closest(double tolerance, bool both_ways, ResultSummary& result) {
    PlannedQuery& planned = plan_->queries[query_];
    planned.budget = search_budget(tolerance);
    planned.outside = true;
    result.cell = planned.budget.cell;
    if (planned.on_cpu || !check_numbers(result)) {
        return;  // ClosestDecoder does the rest on the CPU
    }
    const Stopwatch start;
    localize::Effort effort;
    result.intersects = localize::intersects(TransformedPolygon(*planned.a, planned.pose_a),
                                             TransformedPolygon(*planned.b, planned.pose_b),
                                             limits_.bounding_volume, &effort);
    chains_.clear();
    count(effort, result);
    localize_milliseconds_ += start.milliseconds();
    if (result.intersects) {
        return;  // at distance 0: nothing to render
    }
    const std::uint32_t reverse = both_ways ? add_reverse() : PlannedQuery::none;
    double samples = find_closest_chains(query_, chains_of_[0], result);
    if (both_ways) {
        samples = std::max(samples, find_closest_chains(reverse, chains_of_[1], result));
    }
    // The exact search continues wherever the samples end, so more samples gain nothing.
    result.cell *= std::max(1.0, samples / max_search_samples);
    if (both_ways) {
        add_closest_points(reverse, chains_of_[1], result);
    }
    add_closest_points(query_, chains_of_[0], result);
}

}  // namespace nearfield::plan
