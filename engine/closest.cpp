#include <engine/closest.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/nearest_feature.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace nearfield {
namespace {

using exact::ClosestPair;
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

/// A vertex of `inner` that lies in `outer`, where a ring of it does.
std::optional<Vector> vertex_inside(const PlacedPolygon& inner, const PlacedPolygon& outer) {
    const geometry::Polygon& polygon = inner.polygon();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const Vector vertex = inner.vertex(polygon.ring_begin(ring));
        if (contains(outer, vertex)) {
            return vertex;
        }
    }
    return std::nullopt;
}

/// A point of both shapes, which intersect: where the boundaries meet, or else a vertex of the one
/// in the other.
Vector common_point(const PlacedPolygon& a, const PlacedPolygon& b, const ClosestPair& closest,
                    double rounding) {
    if (std::sqrt(closest.squared_distance) > rounding) {
        for (const auto& vertex : {vertex_inside(a, b), vertex_inside(b, a)}) {
            if (vertex) {
                return *vertex;
            }
        }
    }
    return closest.point_a;
}

double rounding_of(const PlacedPolygon& a, const PlacedPolygon& b) {
    return localize::placement_rounding(a, a.box()) + localize::placement_rounding(b, b.box());
}

/// Everything a SeparationResult says beyond its summary.
void write_pair(const PlannedQuery& query, const ClosestPair& pair, SeparationResult& result) {
    result.distance = std::sqrt(pair.squared_distance);
    result.point_a = geometry::to_public(pair.point_a);
    result.point_b = geometry::to_public(pair.point_b);
    result.direction = geometry::to_public((pair.point_b - pair.point_a) / result.distance);
    result.feature_a =
        feature_at(PlacedPolygon(*query.a, query.pose_a), pair.edge_a, pair.parameter_a);
    result.feature_b =
        feature_at(PlacedPolygon(*query.b, query.pose_b), pair.edge_b, pair.parameter_b);
}

}  // namespace

void ClosestDecoder::decode(const plan::Plan& plan, const PlannedQuery& query,
                            std::span<const std::uint32_t> words, SeparationResult& result) {
    const PlacedPolygon a(*query.a, query.pose_a);
    const PlacedPolygon b(*query.b, query.pose_b);
    const double rounding = rounding_of(a, b);
    result.error_bound = rounding + query.deviations.a + query.deviations.b;
    if (result.intersects) {
        const ClosestPair closest = finder_.find(a, b, infinity);
        result.point_a = geometry::to_public(common_point(a, b, closest, rounding));
        result.point_b = result.point_a;
        return;
    }
    double sampled = sampled_distance(plan, query, words);
    if (query.reverse != PlannedQuery::none) {
        sampled = std::min(sampled, sampled_distance(plan, plan.queries[query.reverse], words));
    }
    const ClosestPair closest = finder_.find(a, b, sampled);
    write_pair(query, closest, result);
    result.error_bound += 8.0 * std::numeric_limits<double>::epsilon() * result.distance;
    result.sampled_distance = query.on_cpu ? result.distance : sampled;
    const exact::Side side = std::holds_alternative<SeparationQuery>(*query.query)
                                 ? exact::Side::either
                                 : exact::Side::a;
    result.unique = finder_.is_unique(closest, side, result.tolerance * plan::uniqueness_margin,
                                      result.tolerance);
}

void ClosestDecoder::decode(const plan::Plan& plan, const PlannedQuery& query,
                            std::span<const std::uint32_t> words, ClosestPointResult& result) {
    SeparationResult separation;
    static_cast<ResultSummary&>(separation) = std::move(static_cast<ResultSummary&>(result));
    decode(plan, query, words, separation);
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
