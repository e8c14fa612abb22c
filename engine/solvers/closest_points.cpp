#include <engine/base/interruption.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/closest_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::solvers {
namespace {

using queries::CheckedQuery;
using simd::TransformedEdges;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The shapes whose closest point has to be unique.
narrowphase::Side side_of(const CheckedQuery& query) {
    return std::holds_alternative<SeparationQuery>(*query.query) ? narrowphase::Side::either
                                                                 : narrowphase::Side::a;
}

}  // namespace

void ClosestSolver::answer_apart(const CheckedQuery& query, const simd::TransformedEdges& a,
                                 const simd::TransformedEdges& b, double at_most,
                                 SeparationResult& result) {
    // Another closest point counts if it is farther away than the tolerance. If neither shape is
    // that large, there is none, and such a margin may cover very many pairs.
    const double extent = std::max(a.box.diagonal().norm(), b.box.diagonal().norm());
    const double margin =
        result.tolerance < extent ? result.tolerance * queries::uniqueness_margin : 0.0;
    const narrowphase::ClosestPair closest = finder_.find(a, b, at_most, margin);
    result.distance = std::sqrt(closest.squared_distance);
    result.error_bound += 8.0 * std::numeric_limits<double>::epsilon() * result.distance;
    write_closest(a.placed, b.placed, closest, result.distance, result);
    result.unique = finder_.is_unique(closest, side_of(query), margin, result.tolerance);
}

void ClosestSolver::answer(const CheckedQuery& query, Workspace& workspace,
                           SeparationResult& result) {
    simd::TransformedInstances& instances = workspace.instances;
    const queries::PlacedPair pair = place_pair(query, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    prepare(pair, instances);
    answer(query, a, b, {overlap_test_.intersect(a, b), infinity}, result);
}

void ClosestSolver::answer(const CheckedQuery& query, const TransformedEdges& a,
                           const TransformedEdges& b, const Known& known,
                           SeparationResult& result) {
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    result.intersects = known.intersect;
    if (known.intersect) {
        result.point_a = result.point_b = geometry::to_public(overlap_test_.common_point(a, b));
    } else {
        answer_apart(query, a, b, known.at_most, result);
        result.sampled_distance = known.at_most < infinity ? known.at_most : result.distance;
    }
}

void ClosestSolver::answer(const CheckedQuery& query, Workspace& workspace,
                           ClosestPointResult& result) {
    SeparationResult separation;
    static_cast<ResultSummary&>(separation) = std::move(static_cast<ResultSummary&>(result));
    answer(query, workspace, separation);
    take_closest_point(std::move(separation), result);
}

void take_closest_point(SeparationResult&& separation, ClosestPointResult& result) {
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

}  // namespace nearfield::solvers
