#include <engine/cpu/separation_vector.hpp>

namespace nearfield::cpu {

void SeparationVector::answer(const plan::PlannedQuery& planned,
                              simd::TransformedInstances& instances,
                              SeparationVectorResult& result) {
    const InstancePairIndex pair = place_pair(planned, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    if (Status status = check_numbers(planned, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    complete(pair, instances);
    result.error_bound = a.rounding + b.rounding + planned.deviations.a + planned.deviations.b;
    const std::uint64_t max_work = std::get<SeparationVectorQuery>(*planned.query).max_work;
    const mtv::SeparatingTranslation way =
        finder_.find(a, b, planned.pose_a, {result.tolerance, max_work});
    result.intersects = way.intersect;
    result.vector = geometry::to_public(way.vector);
    result.length = way.vector.norm();
    result.lower_bound = way.lower_bound;
    result.work = way.work;
}

}  // namespace nearfield::cpu
