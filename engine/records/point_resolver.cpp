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

ResolvedPoint PointResolver::resolve(const plan::PlannedPoint& planned, std::uint32_t word) {
    const Vector point = position(*a_, planned.point);
    const std::uint32_t edge = word & plan::point_edge_mask;
    narrowphase::NearestPoint nearest{edge, nearest_on_edge(*b_, edge, point)};
    bool unique = (word & plan::point_unique) != 0;
    const double far = farthest_in_single_precision * query_->budget.cell;
    if (nearest.on_edge.squared_distance > far * far) {
        nearest = boundary_of_b().nearest(point);
        const double tolerance = query_->budget.cell / std::numbers::sqrt2;
        unique = boundary_of_b().is_unique(point, nearest, tolerance * plan::uniqueness_margin);
    }
    const double distance = std::sqrt(nearest.on_edge.squared_distance);
    return {
        point,
        nearest.on_edge.point,
        distance,
        nearest.edge,
        nearest.on_edge.parameter,
        feature_at(*b_, nearest.edge, nearest.on_edge.parameter),
        (word & plan::point_inside) != 0 &&
            distance > (query_->on_cpu ? rounding_ : touching_distance(plan_->tiles[planned.tile])),
        unique};
}

}  // namespace nearfield::records
