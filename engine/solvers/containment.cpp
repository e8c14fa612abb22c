#include <engine/geometry/segment.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/closest_points.hpp>
#include <engine/solvers/containment.hpp>

#include <cmath>
#include <limits>

namespace nearfield::solvers {

using simd::TransformedEdges;

void ContainmentSolver::write_clearance(const TransformedEdges& a, const TransformedEdges& b,
                                        ContainmentResult& result) {
    simd::EdgePair touching;
    if (overlap_test_.boundaries_meet(a, b, touching)) {
        const geometry::ClosestOfSegments closest =
            geometry::closest_of_segments(a.start(touching.first), a.end(touching.first),
                                          b.start(touching.second), b.end(touching.second));
        result.point_a = result.point_b = geometry::to_public(closest.first);
        return;
    }
    const double rounding = a.rounding + b.rounding;
    const narrowphase::ClosestPair pair =
        finder_.find(a, b, std::numeric_limits<double>::infinity(), rounding);
    result.clearance = std::sqrt(pair.squared_distance);
    write_closest(a.placed, b.placed, pair, result.clearance, result);
    result.error_bound += 8.0 * std::numeric_limits<double>::epsilon() * result.clearance;
    result.unique = finder_.is_unique(pair, narrowphase::Side::either, rounding, rounding);
}

void ContainmentSolver::answer(const queries::CheckedQuery& query, Workspace& workspace,
                               ContainmentResult& result) {
    simd::TransformedInstances& instances = workspace.instances;
    const queries::PlacedPair pair = place_pair(query, instances);
    complete_if_near(pair, instances);
    const TransformedEdges& a = instances[pair.a];
    const TransformedEdges& b = instances[pair.b];
    result.error_bound =
        narrowphase::containment_rounding(a, b) + query.deviations.a + query.deviations.b;
    result.inside = containment_test_.is_inside(a, b);
    result.intersects = result.inside || overlap_test_.intersect(a, b);
    if (result.inside) {
        complete(pair, instances);  // small shapes too: the search needs their trees
        write_clearance(instances[pair.a], instances[pair.b], result);
    }
}

}  // namespace nearfield::solvers
