#include <engine/cpu/intersection_test.hpp>

namespace nearfield::cpu {

bool IntersectionTest::intersect(const plan::PlannedQuery& query,
                                 simd::TransformedInstances& instances) {
    return intersect(place_pair(query, instances), instances);
}

bool IntersectionTest::intersect(const InstancePairIndex& pair,
                                 simd::TransformedInstances& instances) {
    complete_if_near(pair, instances);
    return overlap_test_.intersect(instances[pair.a], instances[pair.b]);
}

void IntersectionTest::answer(const plan::PlannedQuery& query,
                              simd::TransformedInstances& instances,
                              IntersectionTestResult& result) {
    const InstancePairIndex pair = place_pair(query, instances);
    complete_if_near(pair, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    result.error_bound = a.rounding + b.rounding + query.deviations.a + query.deviations.b;
    result.intersects = overlap_test_.intersect(a, b);
}

}  // namespace nearfield::cpu
