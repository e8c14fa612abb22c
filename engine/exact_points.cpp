#include <engine/exact_points.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/gpu_layout.hpp>

#include <numbers>

namespace nearfield {

void ExactPoints::answer(const plan::Plan& plan, std::span<std::uint32_t> words) {
    for (const plan::PlannedQuery& query : plan.queries) {
        if (query.on_cpu && query.point_count > 0) {
            answer(plan, query, words);
        }
    }
}

void ExactPoints::answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                         std::span<std::uint32_t> words) {
    const geometry::PlacedPolygon a(*query.a, query.pose_a);
    const geometry::PlacedPolygon b(*query.b, query.pose_b);
    boundary_.set(b);
    const double margin = query.budget.cell / std::numbers::sqrt2 * plan::uniqueness_margin;
    std::uint32_t edge = 0;
    for (std::uint32_t i = query.first_point; i < query.first_point + query.point_count; ++i) {
        const geometry::Vector point = position(a, plan.points[i].point);
        const bool inside = boundary_.contains(point);
        if (!inside && !query.outside) {
            words[i] = 0;
            continue;
        }
        // Points come in order along a boundary: the edge nearest to one is near the next.
        const exact::NearestPoint nearest = boundary_.nearest(point, edge);
        edge = nearest.edge;
        const bool unique = boundary_.is_unique(point, nearest, margin);
        words[i] = plan::point_resolved | edge | (inside ? plan::point_inside : 0U) |
                   (unique ? plan::point_unique : 0U);
    }
}

}  // namespace nearfield
