#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/intersection_test.hpp>

namespace nearfield::solvers {

void IntersectionTestSolver::answer(const queries::CheckedQuery& query, Workspace& workspace,
                                    IntersectionTestResult& result) {
    const simd::TransformedInstances& instances = workspace.instances;
    const queries::PlacedPair pair = place_pair(query, workspace.instances);
    complete_if_near(pair, workspace.instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    result.intersects = overlap_test_.intersect(a, b);
}

}  // namespace nearfield::solvers
