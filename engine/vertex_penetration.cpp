#include <engine/nearest_feature.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/vertex_penetration.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield {

using exact::PlacedEdges;
using geometry::Vector;

void VertexPenetration::answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                               PenetrationResult& result) {
    const InstancePairIndex pair = place_pair(query, instances);
    const PlacedEdges& a = instances[pair.a];
    const PlacedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    const bool reversed = pair.is_reverse_of(last_.index);
    if (!reversed || last_.intersects) {
        margin_ = result.tolerance * plan::uniqueness_margin;
        find_penetrating(a, b, result, std::get<PenetrationQuery>(*query.query).records);
        result.intersects =
            result.intersects || reversed || meeting_.intersect_without_vertex_inside(a, b);
    }
    last_ = {pair, result.intersects};
}

void VertexPenetration::find_penetrating(const PlacedEdges& a, const PlacedEdges& b,
                                         PenetrationResult& result, bool keep_records) {
    if (!a.box.intersects(b.box)) {
        return;
    }
    const double touching = a.rounding + b.rounding;
    std::uint32_t deepest = 0;
    exact::NearestPoint way_out;
    way_out.on_edge.squared_distance = 0.0;
    const std::span<const std::uint32_t> inside = find_inside(a, b);
    result.intersects = !inside.empty();
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const Vector point = a.start(inside[i]);
        const exact::NearestPoint nearest = find_nearest(b, i, point);
        const double squared = nearest.on_edge.squared_distance;
        if (squared <= touching * touching) {
            continue;
        }
        ++result.count;
        if (keep_records) {
            result.records.push_back(penetration_record(resolve(b, point, nearest)));
        }
        if (squared > way_out.on_edge.squared_distance) {
            deepest = inside[i];
            way_out = nearest;
        }
    }
    if (result.count > 0) {
        result.deepest = penetration_record(resolve(b, a.start(deepest), way_out));
    }
}

std::span<const std::uint32_t> VertexPenetration::find_inside(const PlacedEdges& a,
                                                              const PlacedEdges& b) {
    if (inside_.size() < exact::padded(a.count)) {
        inside_.resize(exact::padded(a.count));
        nearest_.resize(exact::padded(a.count));
    }
    if (exact::is_small(b)) {
        const std::uint32_t count = exact::kernels::find_points_inside(
            a.starts(), exact::extent_of(b.box), b, inside_.data());
        exact::kernels::find_nearest_of(a.starts(), inside_.data(), count, b, nearest_.data());
        return {inside_.data(), count};
    }
    boundary_.set(b.placed);
    const std::uint32_t in_box =
        exact::kernels::find_points_in(a.starts(), exact::extent_of(b.box), inside_.data());
    const auto end =
        std::remove_if(inside_.begin(), inside_.begin() + in_box,
                       [&](std::uint32_t vertex) { return !boundary_.contains(a.start(vertex)); });
    return {inside_.begin(), end};
}

exact::NearestPoint VertexPenetration::find_nearest(const PlacedEdges& b, std::size_t i,
                                                    const Vector& point) {
    if (!exact::is_small(b)) {
        return boundary_.nearest(point);
    }
    const std::uint32_t edge = nearest_[i].edge;
    return {edge, geometry::nearest_on_segment(point, b.start(edge), b.end(edge))};
}

ResolvedPoint VertexPenetration::resolve(const PlacedEdges& b, const Vector& point,
                                         const exact::NearestPoint& nearest) {
    const double parameter = nearest.on_edge.parameter;
    return {point,
            nearest.on_edge.point,
            std::sqrt(nearest.on_edge.squared_distance),
            nearest.edge,
            parameter,
            feature_at(b.placed, nearest.edge, parameter),
            true,
            is_unique(b, point, nearest)};
}

bool VertexPenetration::is_unique(const PlacedEdges& b, const Vector& point,
                                  const exact::NearestPoint& nearest) {
    if (!exact::is_small(b)) {
        return boundary_.is_unique(point, nearest, margin_);
    }
    const double limit = std::sqrt(nearest.on_edge.squared_distance) + margin_;
    // What is clearly farther needs no closer look.
    const std::uint32_t count = exact::kernels::find_edges_within(
        b, point.x(), point.y(), 1.001 * limit * limit, near_.data());
    return std::none_of(near_.begin(), near_.begin() + count, [&](std::uint32_t edge) {
        return exact::is_rival(geometry::nearest_on_segment(point, b.start(edge), b.end(edge)),
                               nearest.on_edge, limit);
    });
}

}  // namespace nearfield
