#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/intersection_test.hpp>

namespace nearfield::solvers {

void IntersectionTestSolver::answer(const queries::CheckedQuery& query, Workspace& workspace,
                                    IntersectionTestResult& result) {
    const queries::PlacedPair pair = place_pair(query, workspace.instances);
    const simd::TransformedEdges& a = workspace.instances[pair.a];
    const simd::TransformedEdges& b = workspace.instances[pair.b];
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    result.intersects = intersect(pair, workspace.instances, overlap_test_);
}

}  // namespace nearfield::solvers
