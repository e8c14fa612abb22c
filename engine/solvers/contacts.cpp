#include <engine/base/interruption.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/queries/grid.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/contacts.hpp>
#include <engine/solvers/nearest_feature.hpp>

#include <utility>

namespace nearfield::solvers {

using geometry::Box;
using geometry::Vector;

void ContactSolver::answer(const queries::CheckedQuery& query, Workspace& workspace,
                           ContactResult& result) {
    simd::TransformedInstances& instances = workspace.instances;
    const queries::PlacedPair pair = place_pair(query, instances);
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
    result.regions.push_back(
        queries::region_of(queries::Grid::covering(of_a.merged(of_b), result.cell)));
    queries::QueryMemory memory = workspace.memory_of(query, result.tolerance);
    require_numbers(query, a, b, memory);
    find(a, b, near, memory, result);
    if (asked.normals == ContactNormals::gradient) {
        result.status = normals_.set(query, result.cell, workspace, found_);
    }
    if (!result.status.ok()) {
        return;
    }
    found_.write(*query.a, *query.b, asked, result);
    if (!result.points.empty()) {
        memory.require(static_cast<double>(result.points.size() * sizeof(ContactPoint)), 1.0);
    }
    result.intersects = result.intersects || overlap_test_.intersect(a, b);
}

void ContactSolver::require_numbers(const queries::CheckedQuery& query,
                                    const simd::TransformedEdges& a,
                                    const simd::TransformedEdges& b, queries::QueryMemory& memory) {
    const auto& asked = std::get<ContactQuery>(*query.query);
    const double cell = query.budget.cell;
    const double rough =
        queries::max_samples(*query.a, cell) + queries::max_samples(*query.b, cell);
    memory.require_alone(0.0, rough, [&] {
        return samples_.max_samples(a, b, asked.contact_distance, cell) +
               samples_.max_samples(b, a, asked.contact_distance, cell);
    });
}

void ContactSolver::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                         double contact_distance, queries::QueryMemory& memory,
                         ContactResult& result) {
    found_.begin(result.cell, a.rounding + b.rounding);
    boundary_.set(b);
    const auto boundary_of_b = [this]() -> narrowphase::Boundary& { return boundary_; };
    for_each_contact(a, b, contact_distance, memory, result,
                     [&](const queries::BoundaryPoint& place, const ResolvedPoint& resolved) {
                         result.intersects = result.intersects || resolved.inside;
                         found_.add_of_a(place, resolved, boundary_of_b);
                     });
    for_each_contact(b, a, contact_distance, memory, result,
                     [&](const queries::BoundaryPoint& place, const ResolvedPoint& resolved) {
                         result.intersects = result.intersects || resolved.inside;
                         found_.add_of_b(place, resolved, boundary_);
                     });
    found_.decide_normals(boundary_of_b);
}

template <class Use>
void ContactSolver::for_each_contact(const simd::TransformedEdges& a,
                                     const simd::TransformedEdges& b, double contact_distance,
                                     queries::QueryMemory& memory, const ContactResult& result,
                                     const Use& use) {
    samples_.find(a, b, contact_distance, result.cell, [&] {
        const simd::PointArrays points = samples_.points().arrays();
        located_.find(points, b,
                      {.margin = result.tolerance * queries::uniqueness_margin,
                       .touching = a.rounding + b.rounding,
                       .reach = contact_distance});
        const simd::NearestArrays& nearest = located_.nearest();
        SparseCheckpoint<64> checkpoint;
        for (std::size_t i = 0; i < points.count; ++i) {
            checkpoint.step();
            if (nearest.distance[i] > contact_distance) {
                continue;
            }
            use(samples_.place(i),
                ResolvedPoint{{points.x[i], points.y[i]},
                              {nearest.x[i], nearest.y[i]},
                              nearest.distance[i],
                              nearest.edge[i],
                              nearest.parameter[i],
                              feature_at(b.placed, nearest.edge[i], nearest.parameter[i]),
                              located_.is_inside(i),
                              located_.is_unique(i)});
        }
        // All contacts are kept until the manifold is made.
        constexpr double kept = sizeof(TransformedContact) + sizeof(ContactPoint);
        const double found = found_.count();
        memory.require_alone(kept, found, [found] { return found; });
    });
}

}  // namespace nearfield::solvers
