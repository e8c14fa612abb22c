#include <engine/base/interruption.hpp>
#include <engine/cpu/exact_points.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/plan/asked_points.hpp>
#include <engine/plan/error_budget.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <numbers>

namespace nearfield::cpu {

void ExactPoints::answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                         simd::TransformedInstances& instances, std::span<std::uint32_t> words) {
    const plan::PlannedPoints& points = query.points();
    if (points.count == 0) {
        return;
    }
    const std::uint32_t b = instances.place(*query.b, query.pose_b);
    if (!is_small(instances[b])) {
        instances.complete(b);
    }
    const geometry::TransformedPolygon a(*query.a, query.pose_a);
    const std::size_t at_once = narrowphase::points_at_once(instances[b].count);
    for (std::uint32_t first = points.first; first < points.end();) {
        const auto count =
            static_cast<std::uint32_t>(std::min<std::size_t>(points.end() - first, at_once));
        points_.clear();
        points_.reserve(count);
        for (const plan::PlannedPoint& planned : std::span(plan.points).subspan(first, count)) {
            const geometry::Vector point = position(a, planned.point);
            points_.push(point.x(), point.y());
        }
        answer(query, localize::placement_rounding(a, a.box()), instances[b],
               words.subspan(first, count));
        first += count;
    }
}

/// Writes the words of the points of a part.
void ExactPoints::answer(const plan::PlannedQuery& query, double rounding_of_a,
                         const simd::TransformedEdges& b, std::span<std::uint32_t> words) {
    const double reach = plan::reach_of(query);
    located_.find(points_.arrays(), b,
                  {.margin = query.budget.cell / std::numbers::sqrt2 * plan::uniqueness_margin,
                   .touching = rounding_of_a + b.rounding,
                   .reach = reach});
    const simd::NearestArrays& nearest = located_.nearest();
    SparseCheckpoint<256> checkpoint;
    for (std::size_t i = 0; i < words.size(); ++i) {
        checkpoint.step();
        words[i] = 0;
        if (nearest.distance[i] > reach) {
            continue;
        }
        const bool inside = located_.is_inside(i);
        if (!query.points().outside && !inside) {
            continue;
        }
        words[i] = plan::point_resolved | nearest.edge[i] | (inside ? plan::point_inside : 0U) |
                   (located_.is_unique(i) ? plan::point_unique : 0U);
    }
}

}  // namespace nearfield::cpu
