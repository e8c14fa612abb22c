#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/separation_vector.hpp>

#include <utility>

namespace nearfield::solvers {

void SeparationVectorSolver::answer(const queries::CheckedQuery& query, Workspace& workspace,
                                    SeparationVectorResult& result) {
    simd::TransformedInstances& instances = workspace.instances;
    const queries::PlacedPair pair = place_pair(query, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    complete(pair, instances);
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    const std::uint64_t max_work = std::get<SeparationVectorQuery>(*query.query).max_work;
    const mtv::SeparatingTranslation way =
        finder_.find(a, b, query.pose_a, {result.tolerance, max_work});
    result.intersects = way.intersect;
    result.vector = geometry::to_public(way.vector);
    result.length = way.vector.norm();
    result.lower_bound = way.lower_bound;
    result.work = way.work;
}

}  // namespace nearfield::solvers
