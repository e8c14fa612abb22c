#include <engine/closest.hpp>
#include <engine/nearest_feature.hpp>
#include <engine/placed_pair.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield {
namespace {

using exact::ClosestPair;
using exact::PlacedEdges;
using geometry::PlacedPolygon;
using geometry::Vector;
using plan::PlannedQuery;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The least distance at the rendered points of one direction.
double sampled_distance(const plan::Plan& plan, const PlannedQuery& query,
                        std::span<const std::uint32_t> words) {
    const PlacedPolygon a(*query.a, query.pose_a);
    const PlacedPolygon b(*query.b, query.pose_b);
    double squared = infinity;
    for (std::uint32_t i = query.first_point; i < query.first_point + query.point_count; ++i) {
        if ((words[i] & plan::point_resolved) != 0) {
            const std::uint32_t edge = words[i] & plan::point_edge_mask;
            const auto nearest =
                geometry::nearest_on_segment(position(a, plan.points[i].point), b.vertex(edge),
                                             b.vertex(b.polygon().next(edge)));
            squared = std::min(squared, nearest.squared_distance);
        }
    }
    return std::sqrt(squared);
}

/// Whose closest point a query asks for.
exact::Side side_of(const PlannedQuery& query) {
    return std::holds_alternative<SeparationQuery>(*query.query) ? exact::Side::either
                                                                 : exact::Side::a;
}

void write_common_point(const Vector& point, SeparationResult& result) {
    result.point_a = result.point_b = geometry::to_public(point);
}

/// Everything a SeparationResult says of shapes that are apart beyond its summary, but for how many
/// such pairs there are and what was rendered.
void write_pair(const PlacedPolygon& a, const PlacedPolygon& b, const ClosestPair& pair,
                SeparationResult& result) {
    result.distance = std::sqrt(pair.squared_distance);
    result.point_a = geometry::to_public(pair.point_a);
    result.point_b = geometry::to_public(pair.point_b);
    result.direction = geometry::to_public((pair.point_b - pair.point_a) / result.distance);
    result.feature_a = feature_at(a, pair.edge_a, pair.parameter_a);
    result.feature_b = feature_at(b, pair.edge_b, pair.parameter_b);
    result.error_bound += 8.0 * std::numeric_limits<double>::epsilon() * result.distance;
}

}  // namespace

void ClosestDecoder::answer_apart(const PlannedQuery& query, const PlacedEdges& a,
                                  const PlacedEdges& b, double at_most, SeparationResult& result) {
    // Another closest point counts where it is farther away than the tolerance. Neither shape
    // reaching so far, there is none to look for, and very many pairs may lie within such a margin.
    const double extent = std::max(a.box.diagonal().norm(), b.box.diagonal().norm());
    const double margin =
        result.tolerance < extent ? result.tolerance * plan::uniqueness_margin : 0.0;
    const ClosestPair closest = finder_.find(a, b, at_most, margin);
    write_pair(a.placed, b.placed, closest, result);
    result.unique = finder_.is_unique(closest, side_of(query), margin, result.tolerance);
}

void ClosestDecoder::answer(const PlannedQuery& query, exact::PlacedInstances& instances,
                            SeparationResult& result) {
    const InstancePairIndex pair = place_pair(query, instances);
    const PlacedEdges& a = instances[pair.a];
    const PlacedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    complete(pair, instances);
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    result.intersects = meeting_.intersect(a, b);
    if (result.intersects) {
        write_common_point(common_point_.find(a, b), result);
    } else {
        answer_apart(query, a, b, infinity, result);
        result.sampled_distance = result.distance;
    }
}

void ClosestDecoder::decode(const plan::Plan& plan, const PlannedQuery& query,
                            std::span<const std::uint32_t> words, exact::PlacedInstances& instances,
                            SeparationResult& result) {
    if (query.on_cpu) {
        answer(query, instances, result);
        return;
    }
    const InstancePairIndex pair = place_pair(query, instances);
    complete(pair, instances);
    const PlacedEdges& a = instances[pair.a];
    const PlacedEdges& b = instances[pair.b];
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    if (result.intersects) {
        write_common_point(common_point_.find(a, b), result);
        return;
    }
    double sampled = sampled_distance(plan, query, words);
    if (query.reverse != PlannedQuery::none) {
        sampled = std::min(sampled, sampled_distance(plan, plan.queries[query.reverse], words));
    }
    answer_apart(query, a, b, sampled, result);
    result.sampled_distance = sampled;
}

void ClosestDecoder::decode(const plan::Plan& plan, const PlannedQuery& query,
                            std::span<const std::uint32_t> words, exact::PlacedInstances& instances,
                            ClosestPointResult& result) {
    SeparationResult separation;
    static_cast<ResultSummary&>(separation) = std::move(static_cast<ResultSummary&>(result));
    decode(plan, query, words, instances, separation);
    static_cast<ResultSummary&>(result) = std::move(static_cast<ResultSummary&>(separation));
    result.point = separation.point_a;
    result.nearest = separation.point_b;
    result.distance = separation.distance;
    result.direction = separation.direction;
    result.feature_a = separation.feature_a;
    result.feature_b = separation.feature_b;
    result.unique = separation.unique;
    result.sampled_distance = separation.sampled_distance;
}

}  // namespace nearfield
