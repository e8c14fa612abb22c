#include <engine/separation_vector.hpp>

namespace nearfield {

void SeparationVector::answer(const plan::PlannedQuery& planned, exact::PlacedInstances& instances,
                              SeparationVectorResult& result) {
    const InstancePairIndex pair = place_pair(planned, instances);
    const exact::PlacedEdges& a = instances[pair.a];
    const exact::PlacedEdges& b = instances[pair.b];
    if (Status status = check_numbers(planned, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    complete(pair, instances);
    result.error_bound = a.rounding + b.rounding + planned.deviations.a + planned.deviations.b;
    const std::uint64_t most_work = std::get<SeparationVectorQuery>(*planned.query).most_work;
    const exact::WayApart way = finder_.find(a, b, planned.pose_a, {result.tolerance, most_work});
    result.intersects = way.intersect;
    result.vector = geometry::to_public(way.vector);
    result.length = way.vector.norm();
    result.lower_bound = way.lower_bound;
    result.work = way.work;
}

}  // namespace nearfield
