#include <engine/intersection_test.hpp>

namespace nearfield {

bool IntersectionTest::intersect(const plan::PlannedQuery& query,
                                 exact::PlacedInstances& instances) {
    const InstancePairIndex pair = place_pair(query, instances);
    complete_if_near(pair, instances);
    return meeting_.intersect(instances[pair.a], instances[pair.b]);
}

void IntersectionTest::answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                              IntersectionTestResult& result) {
    const InstancePairIndex pair = place_pair(query, instances);
    complete_if_near(pair, instances);
    const exact::PlacedEdges& a = instances[pair.a];
    const exact::PlacedEdges& b = instances[pair.b];
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    result.intersects = meeting_.intersect(a, b);
}

}  // namespace nearfield
