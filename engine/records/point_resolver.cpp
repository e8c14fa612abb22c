#include <engine/localize/hierarchy.hpp>
#include <engine/records/nearest_feature.hpp>
#include <engine/records/point_resolver.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nearfield::records {

using geometry::Vector;

namespace {

/// Beyond this many cells, single precision cannot resolve a thousandth of d: the nearest edge is
/// determined again, in double precision.
constexpr double farthest_in_single_precision = 1024.0;

}  // namespace

void PointResolver::begin(const plan::Plan& plan, const plan::PlannedQuery& query) {
    plan_ = &plan;
    query_ = &query;
    a_.emplace(*query.a, query.pose_a);
    b_.emplace(*query.b, query.pose_b);
    boundary_is_set_ = false;
    rounding_ = query.on_cpu ? localize::placement_rounding(*a_, a_->box()) +
                                   localize::placement_rounding(*b_, b_->box())
                             : 0.0;
}

narrowphase::Boundary& PointResolver::boundary_of_b() {
    if (!boundary_is_set_) {
        boundary_.set(*b_);
        boundary_is_set_ = true;
    }
    return boundary_;
}

/// The nearest point of B for one that the device searched: of the edge that it named and its
/// neighbours, among which single precision may not have been able to choose.
narrowphase::NearestPoint PointResolver::nearest_of_neighbours(const Vector& point,
                                                               std::uint32_t edge) const {
    const geometry::Polygon& polygon = b_->polygon();
    narrowphase::NearestPoint nearest{edge, nearest_on_edge(*b_, edge, point)};
    for (const std::uint32_t other : {polygon.previous(edge), polygon.next(edge)}) {
        const geometry::NearestOnSegment on_other = nearest_on_edge(*b_, other, point);
        if (on_other.squared_distance < nearest.on_edge.squared_distance) {
            nearest = {other, on_other};
        }
    }
    return nearest;
}

PointResolver::Found PointResolver::find(const Vector& point, std::uint32_t word) {
    const std::uint32_t edge = word & plan::point_edge_mask;
    const double tolerance = query_->budget.cell / std::numbers::sqrt2;
    Found found{{edge, {}}, (word & plan::point_inside) != 0, (word & plan::point_unique) != 0};
    if (query_->searched && (word & plan::point_doubtful) != 0) {
        found.nearest = boundary_of_b().nearest(point, edge);
        found.inside = boundary_of_b().contains(point);
        found.unique =
            boundary_of_b().is_unique(point, found.nearest, tolerance * plan::uniqueness_margin);
        return found;
    }
    if (query_->margin > plan::search_precision * query_->budget.cell) {
        found.nearest = nearest_of_neighbours(point, edge);
        return found;
    }
    found.nearest.on_edge = nearest_on_edge(*b_, edge, point);
    const double far = farthest_in_single_precision * query_->budget.cell;
    if (!query_->searched && found.nearest.on_edge.squared_distance > far * far) {
        found.nearest = boundary_of_b().nearest(point);
        found.unique =
            boundary_of_b().is_unique(point, found.nearest, tolerance * plan::uniqueness_margin);
    }
    return found;
}

/// Points nearer to the boundary than this touch it.
double PointResolver::touching(const plan::PlannedPoint& planned) const {
    if (query_->on_cpu) {
        return rounding_;
    }
    return query_->searched ? touching_distance(query_->budget.cell, 0)
                            : touching_distance(plan_->tiles[planned.tile]);
}

ResolvedPoint PointResolver::resolve(const plan::PlannedPoint& planned, std::uint32_t word) {
    const Vector point = position(*a_, planned.point);
    const Found found = find(point, word);
    const geometry::NearestOnSegment& on_edge = found.nearest.on_edge;
    const double distance = std::sqrt(on_edge.squared_distance);
    return {point,
            on_edge.point,
            distance,
            found.nearest.edge,
            on_edge.parameter,
            feature_at(*b_, found.nearest.edge, on_edge.parameter),
            found.inside && distance > touching(planned),
            found.unique};
}

}  // namespace nearfield::records
