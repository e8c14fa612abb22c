#include <engine/contacts.hpp>
#include <engine/localize/hierarchy.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield {
namespace {

using geometry::Vector;
using plan::BoundaryPoint;
using plan::PlannedQuery;

// So far from an end of an edge its sides are the edge's own, not a neighbour's.
constexpr double just_inside = 1.0 / 1024.0;

ContactRecord make_record(const ResolvedPoint& resolved, Side on, const Vector& normal) {
    return {geometry::to_public(resolved.point),
            geometry::to_public(normal),
            resolved.distance,
            geometry::to_public(resolved.nearest),
            resolved.feature,
            on,
            resolved.inside,
            resolved.unique};
}

/// Calls `use(planned point, resolved point)` for each point of a query within a distance of B.
template <class Use>
void for_each_near(const plan::Plan& plan, const PlannedQuery& query,
                   std::span<const std::uint32_t> words, double distance, PointResolver& resolver,
                   const Use& use) {
    resolver.begin(plan, query);
    for (std::uint32_t i = query.first_point; i < query.first_point + query.point_count; ++i) {
        if ((words[i] & plan::point_resolved) != 0) {
            const ResolvedPoint resolved = resolver.resolve(plan.points[i], words[i]);
            if (resolved.distance <= distance) {
                use(plan.points[i], resolved);
            }
        }
    }
}

}  // namespace

void ContactDecoder::find(const plan::Plan& plan, const PlannedQuery& query,
                          std::span<const std::uint32_t> words, double cell) {
    const PlannedQuery& reverse = plan.queries[query.reverse];
    if (query.point_count == 0 && reverse.point_count == 0) {
        of_a_.clear();
        of_b_.clear();
        return;
    }
    const geometry::PlacedPolygon a(*query.a, query.pose_a);
    const geometry::PlacedPolygon b(*query.b, query.pose_b);
    touching_ =
        std::max(std::ldexp(cell, -15), 1024.0 * (localize::placement_rounding(a, a.box()) +
                                                  localize::placement_rounding(b, b.box())));
    const double near = std::get<ContactQuery>(*query.query).contact_distance;
    find_contacts_of_a(plan, query, words, near);
    find_contacts_of_b(plan, reverse, words, near);
}

void ContactDecoder::append_points(std::vector<Vector2>& points) const {
    for (const auto* contacts : {&of_a_, &of_b_}) {
        for (const PlacedContact& contact : *contacts) {
            points.push_back(contact.record.point);
        }
    }
}

void ContactDecoder::set_normals(std::span<const Vector2> gradients) {
    constexpr double hardly = 1e-3;
    std::size_t i = 0;
    for (auto* contacts : {&of_a_, &of_b_}) {
        for (PlacedContact& contact : *contacts) {
            const Vector gradient = geometry::to_vector(gradients[i++]);
            const double length = gradient.norm();
            if (length > hardly) {
                contact.record.normal = geometry::to_public(gradient / length);
            } else {
                contact.record.unique = false;
            }
        }
    }
}

void ContactDecoder::write(const PlannedQuery& query, ContactResult& result) {
    result.count = static_cast<std::uint32_t>(of_a_.size() + of_b_.size());
    manifold_.build(*query.a, *query.b, of_a_, of_b_, result.cell, result.manifold);
    if (std::get<ContactQuery>(*query.query).records) {
        for (const auto* contacts : {&of_a_, &of_b_}) {
            for (const PlacedContact& contact : *contacts) {
                result.records.push_back(contact.record);
            }
        }
    }
}

void ContactDecoder::find_contacts_of_a(const plan::Plan& plan, const PlannedQuery& query,
                                        std::span<const std::uint32_t> words,
                                        double contact_distance) {
    of_a_.clear();
    for_each_near(plan, query, words, contact_distance, a_in_b_,
                  [&](const plan::PlannedPoint& planned, const ResolvedPoint& resolved) {
                      of_a_.push_back({make_record(resolved, Side::a, normal_of_b_near(resolved)),
                                       planned.point, planned.point});
                  });
}

void ContactDecoder::find_contacts_of_b(const plan::Plan& plan, const PlannedQuery& reverse,
                                        std::span<const std::uint32_t> words,
                                        double contact_distance) {
    of_b_.clear();
    for_each_near(
        plan, reverse, words, contact_distance, b_in_a_,
        [&](const plan::PlannedPoint& planned, const ResolvedPoint& resolved) {
            of_b_.push_back({make_record(resolved, Side::b, normal_of_b_at(planned.point)),
                             planned.point,
                             {resolved.edge, resolved.parameter}});
        });
}

Vector ContactDecoder::normal_of_b_near(const ResolvedPoint& resolved) {
    // The gradient of the signed distance: away from the nearest point, but where there is hardly a
    // distance and rounding would choose the direction.
    if (resolved.distance > touching_) {
        const Vector away = (resolved.point - resolved.nearest) / resolved.distance;
        return resolved.inside ? Vector(-away) : away;
    }
    return resolved.feature.kind == Feature::Kind::edge
               ? normal_of_b(resolved.edge, resolved.parameter)
               : normal_of_b_at({resolved.feature.index, 0.0});
}

Vector ContactDecoder::normal_of_b(std::uint32_t edge, double parameter) {
    exact::Boundary& boundary = a_in_b_.boundary_of_b();
    const geometry::Polygon& polygon = boundary.polygon().polygon();
    Vector normal = boundary.outward_normal(edge, parameter);
    // An edge of no length has no normal: the next one that has stands in for it.
    for (std::uint32_t other = polygon.next(edge); normal.isZero() && other != edge;
         other = polygon.next(other)) {
        normal = boundary.outward_normal(other, just_inside);
    }
    return normal;
}

Vector ContactDecoder::normal_of_b_at(const BoundaryPoint& point) {
    if (point.parameter > 0.0) {
        return normal_of_b(point.edge, point.parameter);
    }
    // At a vertex, between the normals of its two edges; where these cancel, one of them.
    const geometry::Polygon& polygon = a_in_b_.b().polygon();
    const Vector after = normal_of_b(point.edge, just_inside);
    const Vector sum = normal_of_b(polygon.previous(point.edge), 1.0 - just_inside) + after;
    const double length = sum.norm();
    return length > 1e-9 ? Vector(sum / length) : after;
}

}  // namespace nearfield
