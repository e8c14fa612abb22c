#include <engine/base/interruption.hpp>
#include <engine/cpu/closest.hpp>
#include <engine/cpu/transformed_pair.hpp>
#include <engine/records/nearest_feature.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::cpu {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;
using narrowphase::ClosestPair;
using plan::PlannedQuery;
using simd::TransformedEdges;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The least distance at the rendered points of one direction.
double sampled_distance(const plan::Plan& plan, const PlannedQuery& query,
                        std::span<const std::uint32_t> words) {
    const TransformedPolygon a(*query.a, query.pose_a);
    const TransformedPolygon b(*query.b, query.pose_b);
    double squared = infinity;
    SparseCheckpoint<256> checkpoint;
    const plan::PlannedPoints& points = query.points();
    for (std::uint32_t i = points.first; i < points.end(); ++i) {
        checkpoint.step();
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

/// The shapes whose closest point has to be unique.
narrowphase::Side side_of(const PlannedQuery& query) {
    return std::holds_alternative<SeparationQuery>(*query.query) ? narrowphase::Side::either
                                                                 : narrowphase::Side::a;
}

void write_common_point(const Vector& point, SeparationResult& result) {
    result.point_a = result.point_b = geometry::to_public(point);
}

/// Writes a SeparationResult for separate shapes, except its summary, the number of such pairs and
/// the rendered samples.
void write_pair(const TransformedPolygon& a, const TransformedPolygon& b,
                const narrowphase::ClosestPair& pair, SeparationResult& result) {
    result.distance = std::sqrt(pair.squared_distance);
    result.point_a = geometry::to_public(pair.point_a);
    result.point_b = geometry::to_public(pair.point_b);
    result.direction = geometry::to_public((pair.point_b - pair.point_a) / result.distance);
    result.feature_a = records::feature_at(a, pair.edge_a, pair.parameter_a);
    result.feature_b = records::feature_at(b, pair.edge_b, pair.parameter_b);
    result.error_bound += 8.0 * std::numeric_limits<double>::epsilon() * result.distance;
}

}  // namespace

void ClosestDecoder::answer_apart(const PlannedQuery& query, const simd::TransformedEdges& a,
                                  const simd::TransformedEdges& b, double at_most,
                                  SeparationResult& result) {
    // Another closest point counts if it is farther away than the tolerance. If neither shape is
    // that large, there is none, and such a margin may cover very many pairs.
    const double extent = std::max(a.box.diagonal().norm(), b.box.diagonal().norm());
    const double margin =
        result.tolerance < extent ? result.tolerance * plan::uniqueness_margin : 0.0;
    const narrowphase::ClosestPair closest = finder_.find(a, b, at_most, margin);
    write_pair(a.placed, b.placed, closest, result);
    result.unique = finder_.is_unique(closest, side_of(query), margin, result.tolerance);
}

void ClosestDecoder::answer(const PlannedQuery& query, simd::TransformedInstances& instances,
                            SeparationResult& result) {
    const InstancePairIndex pair = place_pair(query, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    complete(pair, instances);
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    result.intersects = overlap_test_.intersect(a, b);
    if (result.intersects) {
        write_common_point(common_point_.find(a, b), result);
    } else {
        answer_apart(query, a, b, infinity, result);
        result.sampled_distance = result.distance;
    }
}

void ClosestDecoder::decode(const plan::Plan& plan, const PlannedQuery& query,
                            std::span<const std::uint32_t> words,
                            simd::TransformedInstances& instances, SeparationResult& result) {
    if (query.technique == Technique::cpu) {
        answer(query, instances, result);
        return;
    }
    const InstancePairIndex pair = place_pair(query, instances);
    complete(pair, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    if (result.intersects) {
        write_common_point(common_point_.find(a, b), result);
        return;
    }
    double sampled = sampled_distance(plan, query, words);
    const std::uint32_t reverse = query.points().reverse;
    if (reverse != plan::PlannedPoints::none) {
        sampled = std::min(sampled, sampled_distance(plan, plan.queries[reverse], words));
    }
    answer_apart(query, a, b, sampled, result);
    result.sampled_distance = sampled;
}

void ClosestDecoder::decode(const plan::Plan& plan, const PlannedQuery& query,
                            std::span<const std::uint32_t> words,
                            simd::TransformedInstances& instances, ClosestPointResult& result) {
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

}  // namespace nearfield::cpu
