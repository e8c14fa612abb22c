#include <engine/nearest_feature.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/magnitude.hpp>
#include <engine/vertex_penetration.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield {

using exact::PlacedEdges;
using geometry::Vector;

namespace {

bool is_small(const PlacedEdges& edges) {
    return edges.count <= exact::most_edges_one_by_one;
}

Status check_numbers(const plan::PlannedQuery& query, const PlacedEdges& a, const PlacedEdges& b,
                     double tolerance) {
    Status status = plan::check_deviations(tolerance, query.deviations, query.budget.bound);
    return status.ok()
               ? plan::check_resolution(
                     tolerance, std::max(plan::largest_magnitude(a.placed, query.pose_a, a.box),
                                         plan::largest_magnitude(b.placed, query.pose_b, b.box)))
               : status;
}

}  // namespace

void VertexPenetration::answer(const plan::PlannedQuery& query, PenetrationResult& result) {
    const std::uint32_t index_a = instances_.place(*query.a, query.pose_a);
    const std::uint32_t index_b = instances_.place(*query.b, query.pose_b);
    const PlacedEdges a = instances_[index_a];
    const PlacedEdges b = instances_[index_b];
    result.status = check_numbers(query, a, b, result.tolerance);
    if (!result.status.ok()) {
        return;
    }
    margin_ = result.tolerance * plan::uniqueness_margin;
    if (is_small(b)) {
        squared_distances_.resize(exact::most_edges_one_by_one);
    }
    find_penetrating(a, b, result, std::get<PenetrationQuery>(*query.query).records);
    result.intersects = result.intersects || exact::meet_without_vertex_inside(a, b);
}

void VertexPenetration::find_penetrating(const PlacedEdges& a, const PlacedEdges& b,
                                         PenetrationResult& result, bool keep_records) {
    if (!a.box.intersects(b.box)) {
        return;
    }
    if (!is_small(b)) {
        boundary_.set(b.placed);
    }
    const double touching = a.rounding + b.rounding;
    ResolvedPoint deepest;
    for (std::uint32_t first = 0; first < a.count; first += exact::most_edges_one_by_one) {
        const exact::Selection in_box = vertices_in(a, first, b.box);
        for (const std::uint32_t vertex : in_box.indices()) {
            const Vector point = a.start(vertex);
            if (!(is_small(b) ? contains(b, point) : boundary_.contains(point))) {
                continue;
            }
            result.intersects = true;
            ResolvedPoint resolved = resolve(b, point);
            if (resolved.distance <= touching) {
                continue;
            }
            ++result.count;
            const bool is_deepest = resolved.distance > deepest.distance;
            if (keep_records || is_deepest) {
                resolved.unique = is_unique(b, resolved);
            }
            if (keep_records) {
                result.records.push_back(penetration_record(resolved));
            }
            if (is_deepest) {
                deepest = resolved;
            }
        }
    }
    if (result.count > 0) {
        result.deepest = penetration_record(deepest);
    }
}

ResolvedPoint VertexPenetration::resolve(const PlacedEdges& b, const Vector& point) {
    exact::NearestPoint nearest;
    if (is_small(b)) {
        nearest.edge = find_nearest(b, point, squared_distances_);
        nearest.on_edge =
            geometry::nearest_on_segment(point, b.start(nearest.edge), b.end(nearest.edge));
    } else {
        nearest = boundary_.nearest(point);
    }
    const double parameter = nearest.on_edge.parameter;
    return {point,
            nearest.on_edge.point,
            std::sqrt(nearest.on_edge.squared_distance),
            nearest.edge,
            parameter,
            feature_at(b.placed, nearest.edge, parameter),
            true,
            true};
}

bool VertexPenetration::is_unique(const PlacedEdges& b, const ResolvedPoint& resolved) {
    const geometry::NearestOnSegment nearest{resolved.nearest, resolved.parameter,
                                             resolved.distance * resolved.distance};
    if (!is_small(b)) {
        return boundary_.is_unique(resolved.point, {resolved.edge, nearest}, margin_);
    }
    const double limit = resolved.distance + margin_;
    for (std::uint32_t i = 0; i < b.count; ++i) {
        // What is clearly farther needs no closer look.
        if (squared_distances_[i] <= 1.001 * limit * limit &&
            exact::is_rival(geometry::nearest_on_segment(resolved.point, b.start(i), b.end(i)),
                            nearest, limit)) {
            return false;
        }
    }
    return true;
}

}  // namespace nearfield
