#include <engine/batch/contacts.hpp>
#include <engine/geometry/hierarchy.hpp>

namespace nearfield::batch {
namespace {

using device_input::PlannedQuery;

/// Calls `use(place, resolved point)` for each of the resolver's points within a given distance of
/// B.
template <class Use>
void for_each_near(double distance, PointResolver& resolver, const Use& use) {
    resolver.for_each([](std::uint32_t word) { return (word & shaders::point_resolved) != 0; },
                      [&](std::uint32_t i, const solvers::ResolvedPoint& resolved) {
                          if (resolved.distance <= distance) {
                              use(resolver.place(i), resolved);
                          }
                      });
}

}  // namespace

void ContactDecoder::find(const Direction& of_a, const Direction& of_b, double cell,
                          solvers::FoundContacts& found) {
    if (of_a.points.empty() && of_b.points.empty()) {
        found.begin(cell, 0.0);
        return;
    }
    const PlannedQuery& query = of_a.query;
    const geometry::TransformedPolygon a(*query.a, query.pose_a);
    const geometry::TransformedPolygon b(*query.b, query.pose_b);
    found.begin(
        cell, geometry::placement_rounding(a, a.box()) + geometry::placement_rounding(b, b.box()));
    const double near = std::get<ContactQuery>(*query.query).contact_distance;
    const auto boundary_of_b = [this]() -> narrowphase::Boundary& {
        return a_in_b_.boundary_of_b();
    };
    a_in_b_.begin(query, a, b, of_a.points);
    for_each_near(near, a_in_b_,
                  [&](const queries::BoundaryPoint& place, const solvers::ResolvedPoint& resolved) {
                      found.add_of_a(place, resolved, boundary_of_b);
                  });
    b_in_a_.begin(of_b.query, b, a, of_b.points);
    for_each_near(near, b_in_a_,
                  [&](const queries::BoundaryPoint& place, const solvers::ResolvedPoint& resolved) {
                      found.add_of_b(place, resolved, boundary_of_b());
                  });
    found.decide_normals(boundary_of_b);
}

}  // namespace nearfield::batch
