#include <engine/exact/edge_by_edge.hpp>
#include <engine/nearest_feature.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/region.hpp>
#include <engine/point_penetration.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield {

using exact::PlacedEdges;
using exact::PointArrays;
using geometry::Vector;

namespace {

Vector point_of(const PointArrays& points, std::uint32_t i) {
    return {points.x[i], points.y[i]};
}

}  // namespace

void PointPenetration::answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                              PenetrationResult& result) {
    const bool reversed = last_.query + 1 == &query && is_reverse(*last_.query, query);
    const InstancePairIndex pair =
        reversed ? InstancePairIndex{last_.index.b, last_.index.a} : place_pair(query, instances);
    const PlacedEdges& a = instances[pair.a];
    const PlacedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    complete_if_near(pair, instances);
    const auto& asked = std::get<PenetrationQuery>(*query.query);
    if (asked.records && a.box.intersects(b.box)) {
        result.regions.push_back(
            plan::region_of(plan::Grid::covering(a.box.intersection(b.box), result.cell)));
    }
    if (!reversed || last_.intersects) {
        margin_ = result.tolerance * plan::uniqueness_margin;
        if (a.box.intersects(b.box)) {
            const double touching = a.rounding + b.rounding;
            if (asked.points == PenetrationPoints::vertices) {
                find_penetrating(a.starts(), touching, b, result, asked.records);
            } else {
                find_penetrating(samples_.sample(a, b.box, result.cell), touching, b, result,
                                 asked.records);
            }
        }
        // Of a ring of A that lies in B some point is found: it has a vertex that is a sample.
        result.intersects =
            result.intersects || reversed || meeting_.intersect_without_vertex_inside(a, b);
    }
    last_ = {&query, pair, result.intersects};
}

void PointPenetration::find_penetrating(const PointArrays& points, double touching,
                                        const PlacedEdges& b, PenetrationResult& result,
                                        bool keep_records) {
    std::size_t deepest = 0;
    exact::NearestPoint way_out;
    way_out.on_edge.squared_distance = 0.0;
    const std::span<const std::uint32_t> inside = find_inside(points, b);
    result.intersects = !inside.empty();
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const Vector point = point_of(points, inside[i]);
        const exact::NearestPoint nearest = find_nearest(b, i, point);
        const double squared = nearest.on_edge.squared_distance;
        if (squared <= touching * touching) {
            continue;
        }
        ++result.count;
        if (keep_records) {
            result.records.push_back(penetration_record(resolve(b, i, point, nearest)));
        }
        if (squared > way_out.on_edge.squared_distance) {
            deepest = i;
            way_out = nearest;
        }
    }
    if (result.count > 0) {
        result.deepest =
            penetration_record(resolve(b, deepest, point_of(points, inside[deepest]), way_out));
    }
}

std::span<const std::uint32_t> PointPenetration::find_inside(const PointArrays& points,
                                                             const PlacedEdges& b) {
    // Each by itself: where memory ran out between the two, they differ.
    const std::size_t room = exact::padded(points.count);
    inside_.resize(std::max(inside_.size(), room));
    nearest_.resize(std::max(nearest_.size(), room));
    if (!exact::is_small(b)) {
        boundary_.set(b);
        const std::uint32_t in_box =
            exact::kernels::find_points_in(points, exact::extent_of(b.box), inside_.data());
        near_last_ = 0;
        return {inside_.data(), boundary_.keep_inside(points, std::span(inside_).first(in_box))};
    }
    const std::uint32_t count = exact::kernels::find_points_inside(
        points, exact::extent_of(b.box), b, inside_.data(), beside_.data());
    const std::span<const std::uint32_t> inside(inside_.data(), count);
    near_b_.pick(points, inside, b, margin_);
    exact::kernels::find_nearest_of(points, inside_.data(), count, near_b_.edges(),
                                    nearest_.data());
    return inside;
}

exact::NearestPoint PointPenetration::find_nearest(const PlacedEdges& b, std::size_t i,
                                                   const Vector& point) {
    if (!exact::is_small(b)) {
        exact::NearestPoint nearest = boundary_.nearest(point, near_last_);
        near_last_ = nearest.edge;
        return nearest;
    }
    const std::uint32_t edge = near_b_.index(nearest_[i].edge);
    return {edge, geometry::nearest_on_segment(point, b.start(edge), b.end(edge))};
}

ResolvedPoint PointPenetration::resolve(const PlacedEdges& b, std::size_t i, const Vector& point,
                                        const exact::NearestPoint& nearest) {
    const double parameter = nearest.on_edge.parameter;
    return {point,
            nearest.on_edge.point,
            std::sqrt(nearest.on_edge.squared_distance),
            nearest.edge,
            parameter,
            feature_at(b.placed, nearest.edge, parameter),
            true,
            is_unique(b, i, point, nearest)};
}

bool PointPenetration::is_unique(const PlacedEdges& b, std::size_t i, const Vector& point,
                                 const exact::NearestPoint& nearest) {
    if (!exact::is_small(b)) {
        return boundary_.is_unique(point, nearest, margin_);
    }
    const exact::NearestEdges& near = nearest_[i];
    const double limit = std::sqrt(nearest.on_edge.squared_distance) + margin_;
    const double clearly_farther = exact::beyond_rounding(limit);
    if (near.second_squared > clearly_farther) {
        return true;
    }
    if (near.third_squared > clearly_farther) {
        const std::uint32_t edge = near_b_.index(near.second);
        return !exact::is_rival(geometry::nearest_on_segment(point, b.start(edge), b.end(edge)),
                                nearest.on_edge, limit);
    }
    return exact::is_unique(near_b_.edges(), point, nearest, margin_);
}

}  // namespace nearfield
