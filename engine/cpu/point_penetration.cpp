#include <engine/base/interruption.hpp>
#include <engine/cpu/point_penetration.hpp>
#include <engine/narrowphase/brute_force.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/region.hpp>
#include <engine/records/nearest_feature.hpp>

#include <cmath>
#include <utility>

namespace nearfield::cpu {

using geometry::Vector;
using simd::TransformedEdges;

void PointPenetration::answer(const plan::PlannedQuery& query,
                              simd::TransformedInstances& instances, PenetrationResult& result) {
    const bool reversed = last_.query + 1 == &query && is_reverse(*last_.query, query);
    const InstancePairIndex pair =
        reversed ? InstancePairIndex{last_.index.b, last_.index.a} : place_pair(query, instances);
    const simd::TransformedEdges& a = instances[pair.a];
    const simd::TransformedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    complete_if_near(pair, instances);
    const auto& asked = std::get<PenetrationQuery>(*query.query);
    answer(asked, a, b, reversed ? &last_.known : nullptr, result);
    last_ = {&query, pair, {result.intersects, asked.points == PenetrationPoints::boundary}};
}

void PointPenetration::answer(const PenetrationQuery& query, const TransformedEdges& a,
                              const TransformedEdges& b, const Reverse* reverse,
                              PenetrationResult& result) {
    const bool are_near = a.box.intersects(b.box);
    if (!query.summary_only && are_near) {
        result.regions.push_back(
            plan::region_of(plan::Grid::covering(a.box.intersection(b.box), result.cell)));
    }
    if (reverse != nullptr && !reverse->intersects) {
        return;
    }
    inside_.clear();
    if (are_near && query.points == PenetrationPoints::boundary) {
        samples_.find(a, b, reverse != nullptr && reverse->is_sampled, result.cell, inside_);
    } else if (are_near) {
        find_vertices_inside(a.starts(), b);
    }
    const double touching = query.tolerance * plan::touching_depth;
    const double margin = query.tolerance * plan::uniqueness_margin;
    if (!query.summary_only) {
        nearest_.find(inside_.arrays(), b, margin);
        write_records(touching, b, result);
    } else {
        write_deepest(touching, margin, b, result);
    }
    // A ring of A inside B yields at least one point: it has a vertex that is a sample.
    result.intersects = inside_.size() > 0 || reverse != nullptr ||
                        overlap_test_.intersect_without_vertex_inside(a, b);
}

void PointPenetration::find_vertices_inside(const simd::PointArrays& vertices,
                                            const simd::TransformedEdges& b) {
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
}

void PointPenetration::write_deepest(double touching, double margin,
                                     const simd::TransformedEdges& b, PenetrationResult& result) {
    const narrowphase::DeepestPoint deepest = deepest_.find(inside_.arrays(), b, touching, margin);
    result.count = deepest.count;
    if (deepest.count == 0) {
        return;
    }
    const simd::PointArrays points = inside_.arrays();
    const Vector point(points.x[deepest.point], points.y[deepest.point]);
    const std::uint32_t edge = deepest.nearest.edge;
    const narrowphase::NearestPoint exit{
        edge, geometry::nearest_on_segment(point, b.start(edge), b.end(edge))};
    const double depth = std::sqrt(exit.on_edge.squared_distance);
    const bool unique = deepest.nearest.second_squared > simd::beyond_rounding(depth + margin) ||
                        is_unique(b, point, exit, margin);
    write({point, exit.on_edge.point, depth, edge, exit.on_edge.parameter, unique}, b,
          result.deepest);
}

bool PointPenetration::is_unique(const simd::TransformedEdges& b, const Vector& point,
                                 const narrowphase::NearestPoint& nearest, double margin) {
    if (is_small(b)) {
        return narrowphase::is_unique(b, point, nearest, margin);
    }
    boundary_.set(b);
    return boundary_.is_unique(point, nearest, margin);
}

void PointPenetration::write_records(double touching, const simd::TransformedEdges& b,
                                     PenetrationResult& result) {
    const simd::PointArrays points = inside_.arrays();
    const simd::NearestArrays& nearest = nearest_.arrays();
    std::size_t deepest = 0;
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
        if (depth > result.points[deepest].depth) {
            deepest = result.points.size() - 1;
        }
    }
    result.count = static_cast<std::uint32_t>(result.points.size());
    if (result.count > 0) {
        result.deepest = result.points[deepest];
    }
}

void PointPenetration::write(const WayOut& way, const simd::TransformedEdges& b,
                             PenetratingPoint& record) {
    record.position = geometry::to_public(way.point);
    record.depth = way.depth;
    record.direction = geometry::to_public((way.exit - way.point) / way.depth);
    record.nearest = geometry::to_public(way.exit);
    record.feature = records::feature_at(b.placed, way.edge, way.parameter);
    record.unique = way.unique;
}

}  // namespace nearfield::cpu
