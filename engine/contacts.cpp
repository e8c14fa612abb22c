#include <engine/boundary_normal.hpp>
#include <engine/contacts.hpp>
#include <engine/localize/hierarchy.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield {
namespace {

using geometry::Vector;
using plan::BoundaryPoint;
using plan::PlannedQuery;

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
    const geometry::PlacedPolygon a(*query.a, query.pose_a);
    const geometry::PlacedPolygon b(*query.b, query.pose_b);
    touching_ =
        std::max(std::ldexp(cell, -15), 1024.0 * (localize::placement_rounding(a, a.box()) +
                                                  localize::placement_rounding(b, b.box())));
    const double near = std::get<ContactQuery>(*query.query).contact_distance;
    find_contacts_of_a(plan, query, words, near);
    find_contacts_of_b(plan, plan.queries[query.reverse], words, near);
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
            of_b_.push_back({make_record(resolved, Side::b,
                                         outward_normal_at(a_in_b_.boundary_of_b(), planned.point)),
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
    exact::Boundary& boundary = a_in_b_.boundary_of_b();
    return resolved.feature.kind == Feature::Kind::edge
               ? outward_normal(boundary, resolved.edge, resolved.parameter)
               : outward_normal_at(boundary, {resolved.feature.index, 0.0});
}

}  // namespace nearfield
