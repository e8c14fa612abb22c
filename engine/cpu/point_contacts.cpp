#include <engine/base/interruption.hpp>
#include <engine/cpu/point_contacts.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/region.hpp>
#include <engine/records/nearest_feature.hpp>

#include <utility>

namespace nearfield::cpu {

using geometry::Box;
using geometry::Vector;

void PointContacts::answer(const plan::PlannedQuery& query, simd::TransformedInstances& instances,
                           ContactResult& result) {
    const InstancePairIndex pair = place_pair(query, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    const auto& asked = std::get<ContactQuery>(*query.query);
    const double near = asked.contact_distance;
    const Box of_a = a.box.intersection(geometry::grown(b.box, near));
    const Box of_b = b.box.intersection(geometry::grown(a.box, near));
    if (of_a.isEmpty() || of_b.isEmpty()) {
        complete_if_near(pair, instances);
        result.intersects = overlap_test_.intersect(a, b);
        return;
    }
    complete(pair, instances);
    result.regions.push_back(plan::region_of(plan::Grid::covering(of_a.merged(of_b), result.cell)));
    find(a, b, near, result);
    found_.write(*query.a, *query.b, asked, result);
    result.intersects = result.intersects || overlap_test_.intersect(a, b);
}

void PointContacts::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                         double contact_distance, ContactResult& result) {
    found_.begin(result.cell, a.rounding + b.rounding);
    boundary_.set(b);
    const auto boundary_of_b = [this]() -> narrowphase::Boundary& { return boundary_; };
    for_each_contact(a, b, contact_distance, result,
                     [&](const plan::BoundaryPoint& place, const records::ResolvedPoint& resolved) {
                         result.intersects = result.intersects || resolved.inside;
                         found_.add_of_a(place, resolved, boundary_of_b);
                     });
    for_each_contact(b, a, contact_distance, result,
                     [&](const plan::BoundaryPoint& place, const records::ResolvedPoint& resolved) {
                         result.intersects = result.intersects || resolved.inside;
                         found_.add_of_b(place, resolved, boundary_);
                     });
    found_.decide_normals(boundary_of_b);
}

template <class Use>
void PointContacts::for_each_contact(const simd::TransformedEdges& a,
                                     const simd::TransformedEdges& b, double contact_distance,
                                     const ContactResult& result, const Use& use) {
    samples_.find(a, b, contact_distance, result.cell);
    const simd::PointArrays points = samples_.points().arrays();
    if (points.count == 0) {
        return;
    }
    located_.find(points, b,
                  {.margin = result.tolerance * plan::uniqueness_margin,
                   .touching = a.rounding + b.rounding,
                   .reach = contact_distance});
    const simd::NearestArrays& nearest = located_.nearest();
    SparseCheckpoint<64> checkpoint;
    for (std::size_t i = 0; i < points.count; ++i) {
        checkpoint.step();
        if (nearest.distance[i] > contact_distance) {
            continue;
        }
        const Vector point(points.x[i], points.y[i]);
        use(samples_.place(i), records::ResolvedPoint{point,
                                                      {nearest.x[i], nearest.y[i]},
                                                      nearest.distance[i],
                                                      nearest.edge[i],
                                                      nearest.parameter[i],
                                                      records::feature_at(b.placed, nearest.edge[i],
                                                                          nearest.parameter[i]),
                                                      located_.is_inside(i),
                                                      located_.is_unique(i)});
    }
}

}  // namespace nearfield::cpu
