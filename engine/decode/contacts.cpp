#include <engine/decode/contacts.hpp>
#include <engine/localize/hierarchy.hpp>

namespace nearfield::decode {
namespace {

using plan::PlannedQuery;

/// Calls `use(planned point, resolved point)` for each point of a query within a given distance of
/// B.
template <class Use>
void for_each_near(const plan::Plan& plan, const PlannedQuery& query,
                   std::span<const std::uint32_t> words, double distance,
                   records::PointResolver& resolver, const Use& use) {
    resolver.begin(plan, query, words);
    resolver.for_each([words](std::uint32_t i) { return (words[i] & plan::point_resolved) != 0; },
                      [&](std::uint32_t i, const records::ResolvedPoint& resolved) {
                          if (resolved.distance <= distance) {
                              use(plan.points[i], resolved);
                          }
                      });
}

}  // namespace

void ContactDecoder::find(const plan::Plan& plan, const PlannedQuery& query,
                          std::span<const std::uint32_t> words, double cell,
                          records::FoundContacts& found) {
    const PlannedQuery& reverse = plan.queries[query.points().reverse];
    if (query.points().count == 0 && reverse.points().count == 0) {
        found.begin(cell, 0.0);
        return;
    }
    const geometry::TransformedPolygon a(*query.a, query.pose_a);
    const geometry::TransformedPolygon b(*query.b, query.pose_b);
    found.begin(
        cell, localize::placement_rounding(a, a.box()) + localize::placement_rounding(b, b.box()));
    const double near = std::get<ContactQuery>(*query.query).contact_distance;
    const auto boundary_of_b = [this]() -> narrowphase::Boundary& {
        return a_in_b_.boundary_of_b();
    };
    for_each_near(plan, query, words, near, a_in_b_,
                  [&](const plan::PlannedPoint& planned, const records::ResolvedPoint& resolved) {
                      found.add_of_a(planned.point, resolved, boundary_of_b);
                  });
    for_each_near(plan, reverse, words, near, b_in_a_,
                  [&](const plan::PlannedPoint& planned, const records::ResolvedPoint& resolved) {
                      found.add_of_b(planned.point, resolved, boundary_of_b());
                  });
    found.decide_normals(boundary_of_b);
}

}  // namespace nearfield::decode
