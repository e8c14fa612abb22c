#include <tools/io/query_request.hpp>

namespace nearfield::tools {

Technique technique_of(const QueryRequest& request) noexcept {
    const bool names_a_way_of_drawing =
        (request.type == QueryType::intersection && request.strategy) ||
        (request.type == QueryType::distance_field && request.sign);
    return request.technique.value_or(names_a_way_of_drawing ? Technique::raster
                                                             : Technique::automatic);
}

void add_query(Batch& batch, const QueryRequest& request, const Instance& a, const Instance& b) {
    const Technique technique = technique_of(request);
    switch (request.type) {
        case QueryType::penetration:
            batch.add(PenetrationQuery{a, b, request.tolerance, request.points, !request.records,
                                       technique});
            break;
        case QueryType::intersection:
            batch.add(IntersectionQuery{a, b, request.tolerance, request.kind, !request.records,
                                        request.strategy.value_or(IntersectionStrategy::stencil),
                                        technique});
            break;
        case QueryType::distance_field:
            batch.add(DistanceFieldQuery{a, b, request.tolerance, request.rectangle,
                                         request.sign.value_or(SignEncoding::stencil),
                                         request.gradient.value_or(GradientMethod::analytic),
                                         request.values, request.features, request.gradients,
                                         request.at, technique});
            break;
        case QueryType::contacts:
            batch.add(ContactQuery{a, b, request.tolerance,
                                   request.contact_distance.value_or(request.tolerance),
                                   request.normals, !request.records, technique});
            break;
        case QueryType::closest_point:
            batch.add(ClosestPointQuery{a, b, request.tolerance, technique});
            break;
        case QueryType::separation:
            batch.add(SeparationQuery{a, b, request.tolerance, technique});
            break;
        case QueryType::intersection_test:
            batch.add(IntersectionTestQuery{a, b, technique});
            break;
        case QueryType::containment:
            batch.add(ContainmentQuery{a, b, technique});
            break;
        case QueryType::separation_vector:
            batch.add(SeparationVectorQuery{a, b, request.tolerance, request.max_work, technique});
            break;
        case QueryType::time_of_impact:
            batch.add(TimeOfImpactQuery{a, b, request.end_a.value_or(a.pose),
                                        request.end_b.value_or(b.pose), request.tolerance,
                                        request.time_bound, request.max_steps,
                                        request.contact_distance.value_or(0.0), technique});
            break;
    }
}

}  // namespace nearfield::tools
