#include <engine/base/interruption.hpp>
#include <engine/cpu/exact_points.hpp>
#include <engine/narrowphase/brute_force.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/gpu_layout.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

namespace nearfield::cpu {

namespace {

/// The largest distance from B of interest for points outside B.
double reach_of(const plan::PlannedQuery& query) {
    const auto* const contacts = std::get_if<ContactQuery>(query.query);
    return contacts == nullptr ? std::numeric_limits<double>::infinity()
                               : contacts->contact_distance;
}

}  // namespace

void ExactPoints::answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                         simd::TransformedInstances& instances, std::span<std::uint32_t> words) {
    if (query.point_count > 0) {
        const std::uint32_t b = instances.place(*query.b, query.pose_b);
        if (!is_small(instances[b])) {
            instances.complete(b);
        }
        answer(plan, query, instances[b], words);
    }
}

void ExactPoints::answer(const plan::Plan& plan, const plan::PlannedQuery& query,
                         const simd::TransformedEdges& b, std::span<std::uint32_t> words) {
    const geometry::TransformedPolygon a(*query.a, query.pose_a);
    if (!is_small(b)) {
        boundary_.set(b);
    }
    const double margin = query.budget.cell / std::numbers::sqrt2 * plan::uniqueness_margin;
    const double reach = reach_of(query);
    std::uint32_t edge = 0;
    SparseCheckpoint<256> checkpoint;
    for (std::uint32_t i = query.first_point; i < query.first_point + query.point_count; ++i) {
        checkpoint.step();
        words[i] = 0;
        const geometry::Vector point = position(a, plan.points[i].point);
        if (!query.outside && !contains(b, point)) {
            continue;
        }
        // Points are in order along a boundary: the edge nearest to one is near the next.
        const narrowphase::NearestPoint near = nearest(b, point, edge);
        edge = near.edge;
        if (std::sqrt(near.on_edge.squared_distance) > reach) {
            continue;
        }
        const bool inside = !query.outside || contains(b, point);
        const bool unique = is_unique(b, point, near, margin);
        words[i] = plan::point_resolved | edge | (inside ? plan::point_inside : 0U) |
                   (unique ? plan::point_unique : 0U);
    }
}

bool ExactPoints::contains(const simd::TransformedEdges& b, const geometry::Vector& point) {
    return is_small(b) ? simd::kernels::contain(b, point.x(), point.y())
                       : boundary_.contains(point);
}

narrowphase::NearestPoint ExactPoints::nearest(const simd::TransformedEdges& b,
                                               const geometry::Vector& point,
                                               std::uint32_t first_guess) {
    return is_small(b) ? narrowphase::nearest(b, point) : boundary_.nearest(point, first_guess);
}

bool ExactPoints::is_unique(const simd::TransformedEdges& b, const geometry::Vector& point,
                            const narrowphase::NearestPoint& nearest, double margin) {
    return is_small(b) ? narrowphase::is_unique(b, point, nearest, margin)
                       : boundary_.is_unique(point, nearest, margin);
}

}  // namespace nearfield::cpu
