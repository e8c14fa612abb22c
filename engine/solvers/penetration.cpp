#include <engine/base/interruption.hpp>
#include <engine/narrowphase/brute_force.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/queries/grid.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/nearest_feature.hpp>
#include <engine/solvers/penetration.hpp>

#include <cmath>
#include <utility>

namespace nearfield::solvers {

using geometry::Vector;
using simd::TransformedEdges;

void PenetrationSolver::answer(const queries::CheckedQuery& query, Workspace& workspace,
                               PenetrationResult& result) {
    simd::TransformedInstances& instances = workspace.instances;
    const queries::PlacedPair pair = queries::is_reverse(before_, query)
                                         ? queries::PlacedPair{before_.placed.b, before_.placed.a}
                                         : place_pair(query, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    const auto& asked = std::get<PenetrationQuery>(*query.query);
    if (asked.points == PenetrationPoints::boundary) {
        complete_if_near(pair, instances);
    } else if (needs_trees(pair, instances)) {
        prepare(pair, instances);
    }
    queries::QueryMemory memory = workspace.memory_of(query, result.tolerance);
    require_room(query, a, b, memory);
    answer(asked, query, a, b, result);
    before_.placed = pair;
    if (!result.points.empty()) {
        memory.require(static_cast<double>(result.points.size() * sizeof(PenetratingPoint)), 1.0);
    }
}

void PenetrationSolver::require_room(const queries::CheckedQuery& query, const TransformedEdges& a,
                                     const TransformedEdges& b, queries::QueryMemory& memory) {
    const auto& asked = std::get<PenetrationQuery>(*query.query);
    const double kept = !asked.summary_only ? sizeof(PenetratingPoint) : 0.0;
    const double rough = queries::max_points(query);
    memory.require_alone(kept, rough, [&] {
        if (!a.box.intersects(b.box)) {
            return 0.0;
        }
        return asked.points == PenetrationPoints::vertices
                   ? rough
                   : samples_.max_samples(a, b, query.budget.cell);
    });
}

void PenetrationSolver::answer(const PenetrationQuery& query, const queries::ShapePair& shapes,
                               const TransformedEdges& a, const TransformedEdges& b,
                               PenetrationResult& result) {
    const bool is_sampled = query.points == PenetrationPoints::boundary;
    const Before before = std::exchange(before_, {});
    const bool reversed = queries::is_reverse(before, shapes);
    const bool are_near = a.box.intersects(b.box);
    if (!query.summary_only && are_near) {
        result.regions.push_back(
            queries::region_of(queries::Grid::covering(a.box.intersection(b.box), result.cell)));
    }
    if (reversed && !before.intersects) {
        before_ = {shapes, false, is_sampled};
        return;
    }
    bool any_inside = false;
    const auto take = [&] {
        any_inside = any_inside || inside_.size() > 0;
        if (!query.summary_only) {
            add_records(query.tolerance, b, result);
        } else {
            add_deepest(query.tolerance, b, result);
        }
    };
    inside_.clear();
    if (are_near && is_sampled) {
        samples_.find(a, b, reversed && before.is_sampled, result.cell, inside_, take);
    } else if (are_near) {
        const double touching = query.tolerance * shaders::touching_depth;
        result.count += find_vertices_inside(a, b, query.summary_only, touching);
        any_inside = result.count > 0;
    }
    take();
    // A ring of A inside B yields at least one point: it has a vertex that is a sample.
    result.intersects =
        any_inside || reversed || overlap_test_.intersect_without_vertex_inside(a, b);
    before_ = {shapes, result.intersects, is_sampled};
}

std::uint32_t PenetrationSolver::find_vertices_inside(const TransformedEdges& a,
                                                      const TransformedEdges& b, bool summary_only,
                                                      double touching) {
    const bool has_boxes = summary_only && !is_small(a) && !is_small(b) && a.tree().is_in_order() &&
                           a.placed.polygon().find_boxes(geometry::BoxSearch::vertices) != nullptr;
    if (has_boxes) {
        vertices_.find(a, b, touching, inside_);
        boundary_.set(b);
        inside_.resize(
            boundary_.keep_inside(static_cast<std::uint32_t>(inside_.size()), inside_.found()));
        return vertices_.left_out();
    }
    const simd::PointArrays vertices = a.all_starts();
    inside_.reserve(vertices.count);
    const simd::Extent box = geometry::extent_of(b.box);
    const simd::FoundPoints found = inside_.found();
    if (is_small(b)) {
        inside_.resize(simd::kernels::find_points_inside(vertices, box, b, beside_.data(), found));
    } else {
        boundary_.set(b);
        inside_.resize(
            boundary_.keep_inside(simd::kernels::find_points_in(vertices, box, found), found));
    }
    return 0;
}

void PenetrationSolver::add_deepest(double tolerance, const simd::TransformedEdges& b,
                                    PenetrationResult& result) {
    const double touching = tolerance * shaders::touching_depth;
    const double margin = tolerance * queries::uniqueness_margin;
    const narrowphase::DeepestPoint deepest = deepest_.find(inside_.arrays(), b, touching, margin);
    if (deepest.count == 0) {
        return;
    }
    result.count += deepest.count;
    const simd::PointArrays points = inside_.arrays();
    const Vector point(points.x[deepest.point], points.y[deepest.point]);
    const std::uint32_t edge = deepest.nearest.edge;
    const narrowphase::NearestPoint exit{
        edge, geometry::nearest_on_segment(point, b.start(edge), b.end(edge))};
    const double depth = std::sqrt(exit.on_edge.squared_distance);
    if (depth <= result.deepest.depth) {
        return;  // than one of the points before
    }
    const bool unique = deepest.nearest.second_squared > simd::beyond_rounding(depth + margin) ||
                        is_unique(b, point, exit, margin);
    write({point, exit.on_edge.point, depth, edge, exit.on_edge.parameter, unique}, b,
          result.deepest);
}

bool PenetrationSolver::is_unique(const simd::TransformedEdges& b, const Vector& point,
                                  const narrowphase::NearestPoint& nearest, double margin) {
    if (is_small(b)) {
        return narrowphase::is_unique(b, point, nearest, margin);
    }
    boundary_.set(b);
    return boundary_.is_unique(point, nearest, margin);
}

void PenetrationSolver::add_records(double tolerance, const simd::TransformedEdges& b,
                                    PenetrationResult& result) {
    const double touching = tolerance * shaders::touching_depth;
    const simd::PointArrays points = inside_.arrays();
    nearest_.find(points, b, tolerance * queries::uniqueness_margin);
    const simd::NearestArrays& nearest = nearest_.arrays();
    double deepest = result.deepest.depth;
    std::size_t deepest_record = result.points.size();
    SparseCheckpoint<256> checkpoint;
    for (std::size_t i = 0; i < points.count; ++i) {
        checkpoint.step();
        const double depth = nearest.distance[i];
        if (depth <= touching) {
            continue;
        }
        write({{points.x[i], points.y[i]},
               {nearest.x[i], nearest.y[i]},
               depth,
               nearest.edge[i],
               nearest.parameter[i],
               nearest_.is_unique(i)},
              b, result.points.emplace_back());
        if (depth > deepest) {
            deepest = depth;
            deepest_record = result.points.size() - 1;
        }
    }
    result.count = static_cast<std::uint32_t>(result.points.size());
    if (deepest_record < result.points.size() && deepest > result.deepest.depth) {
        result.deepest = result.points[deepest_record];
    }
}

void PenetrationSolver::write(const WayOut& way, const simd::TransformedEdges& b,
                              PenetratingPoint& record) {
    record.position = geometry::to_public(way.point);
    record.depth = way.depth;
    record.direction = geometry::to_public((way.exit - way.point) / way.depth);
    record.nearest = geometry::to_public(way.exit);
    record.feature = feature_at(b.placed, way.edge, way.parameter);
    record.unique = way.unique;
}

}  // namespace nearfield::solvers
