#include <engine/base/interruption.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/solvers/found_contacts.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nearfield::solvers {

using geometry::Vector;

void FoundContacts::begin(double cell, double rounding) {
    touching_depth_ = cell / std::numbers::sqrt2 * shaders::touching_depth;
    undirected_ = std::max(std::ldexp(cell, -15), 1024.0 * rounding);
    of_a_.clear();
    of_b_.clear();
    normals_of_a_.clear();
    normals_of_b_.clear();
}

void FoundContacts::append_points(std::vector<Vector2>& points) const {
    for (const auto* contacts : {&of_a_, &of_b_}) {
        for (const TransformedContact& contact : *contacts) {
            points.push_back(contact.record.position);
        }
    }
}

void FoundContacts::set_normals(std::span<const Vector2> gradients) {
    constexpr double hardly = 1e-3;
    std::size_t i = 0;
    for (auto* contacts : {&of_a_, &of_b_}) {
        for (TransformedContact& contact : *contacts) {
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

void FoundContacts::write(const geometry::Polygon& a, const geometry::Polygon& b,
                          const ContactQuery& query, ContactResult& result) {
    result.count = count();
    manifold_.build(a, b, of_a_, of_b_, result.cell, result.manifold);
    if (!query.summary_only) {
        SparseCheckpoint<1024> checkpoint;
        for (const auto* contacts : {&of_a_, &of_b_}) {
            for (const TransformedContact& contact : *contacts) {
                checkpoint.step();
                result.points.push_back(contact.record);
            }
        }
    }
}

ContactPoint FoundContacts::make_record(const ResolvedPoint& resolved, Side on,
                                        const Vector& normal) const {
    return {geometry::to_public(resolved.point),
            geometry::to_public(normal),
            resolved.distance,
            geometry::to_public(resolved.nearest),
            resolved.feature,
            on,
            resolved.inside && resolved.distance > touching_depth_,
            resolved.unique};
}

Vector FoundContacts::growth_of_distance(const ResolvedPoint& resolved) {
    const Vector away = (resolved.point - resolved.nearest) / resolved.distance;
    return resolved.inside ? Vector(-away) : away;
}

AskedBoundaryNormal FoundContacts::ask_normal_at_nearest(narrowphase::Boundary& boundary,
                                                         const ResolvedPoint& resolved) {
    return resolved.feature.kind == Feature::Kind::edge
               ? ask_outward_normal(boundary, resolved.edge, resolved.parameter)
               : ask_outward_normal_at(boundary, {resolved.feature.index, 0.0});
}

void FoundContacts::decide_normals_by(narrowphase::Boundary& boundary_of_b) {
    boundary_of_b.answer_asked();
    const auto decide = [&](std::vector<NormalOfContact>& normals,
                            std::vector<TransformedContact>& contacts) {
        for (const NormalOfContact& normal : normals) {
            contacts[normal.contact].record.normal =
                geometry::to_public(outward_normal(boundary_of_b, normal.asked));
        }
        normals.clear();
    };
    decide(normals_of_a_, of_a_);
    decide(normals_of_b_, of_b_);
}

}  // namespace nearfield::solvers
