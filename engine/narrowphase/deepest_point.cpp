#include <engine/base/interruption.hpp>
#include <engine/narrowphase/brute_force.hpp>
#include <engine/narrowphase/deepest_point.hpp>

#include <array>
#include <cmath>

namespace nearfield::narrowphase {
namespace {

using geometry::Vector;

/// For this few points, testing each against several edges at once is faster than testing all
/// against one edge at a time.
constexpr std::uint32_t few_points = 4;

/// Adaptive sampling pays from these numbers of points and edges on.
constexpr std::uint32_t many_points = 128;
constexpr std::uint32_t many_edges = 32;

DeepestPoint find_one_by_one(const simd::PointArrays& points, const simd::TransformedEdges& edges,
                             double touching) {
    DeepestPoint deepest;
    for (std::uint32_t i = 0; i < points.count; ++i) {
        const simd::NearestOfEdges near =
            simd::kernels::find_nearest(edges, points.x[i], points.y[i]);
        deepest.count += near.squared > touching * touching ? 1U : 0U;
        if (near.squared > deepest.nearest.squared) {
            deepest.point = i;
            deepest.nearest = near;
        }
    }
    return deepest;
}

}  // namespace

DeepestPoint DeepestPointFinder::find(const simd::PointArrays& points,
                                      const simd::TransformedEdges& edges, double touching,
                                      double margin) {
    if (points.count <= few_points && is_small(edges)) {
        return find_one_by_one(points, edges, touching);
    }
    points_ = points;
    edges_ = &edges;
    touching_ = touching;
    depth_ = 0.0;
    deepest_ = {};
    if (points.count >= many_points && edges.count >= many_edges && !is_crowded()) {
        find_by_adaptive_sampling();
    } else {
        find_together(margin);
    }
    return deepest_;
}

/// Whether points lie in the boxes of so many edges that a search for the nearest takes longer than
/// its share when all points are located together.
bool DeepestPointFinder::is_crowded() {
    if (is_small(*edges_)) {
        return false;
    }
    constexpr std::uint32_t looked_at = 16;
    constexpr std::uint32_t many_boxes = 32;
    if (near_.size() < simd::padded(edges_->count)) {
        near_.resize(simd::padded(edges_->count));
    }
    const simd::AabbTree tree = edges_->tree();
    std::uint32_t crowded = 0;
    for (std::uint32_t i = 0; i < looked_at; ++i) {
        const std::size_t point = std::size_t{points_.count} * i / looked_at;
        const double x = points_.x[point];
        const double y = points_.y[point];
        crowded +=
            simd::kernels::find_edges_in(tree, {x, y, x, y}, near_.data()) > many_boxes ? 1U : 0U;
    }
    return 2 * crowded >= looked_at;
}

void DeepestPointFinder::find_together(double margin) {
    nearest_.find(points_, *edges_, margin);
    const simd::NearestArrays& nearest = nearest_.arrays();
    for (std::uint32_t i = 0; i < points_.count; ++i) {
        take(i, nearest.distance[i], nearest.edge[i]);
    }
    deepest_.nearest.second_squared = nearest.second_squared[deepest_.point];
}

void DeepestPointFinder::take(std::uint32_t point, double depth, std::uint32_t edge) {
    deepest_.count += depth > touching_ ? 1U : 0U;
    if (depth > depth_ || (depth == depth_ && point < deepest_.point)) {
        deepest_.point = point;
        deepest_.nearest.edge = edge;
        depth_ = depth;
    }
}

DeepestPointFinder::DepthProbe DeepestPointFinder::sound(std::uint32_t point) {
    checkpoint_.step();
    const Vector at(points_.x[point], points_.y[point]);
    const NearestPoint near =
        is_small(*edges_) ? nearest(*edges_, at) : boundary_.nearest(at, guess_);
    guess_ = near.edge;
    const DepthProbe sounding{point, std::sqrt(near.on_edge.squared_distance)};
    take(point, sounding.depth, near.edge);
    return sounding;
}

void DeepestPointFinder::find_by_adaptive_sampling() {
    if (!is_small(*edges_)) {
        boundary_.set(*edges_);
    }
    guess_ = 0;
    probes_.clear();
    const std::uint32_t last = points_.count - 1;
    for (std::uint32_t i = 0; i < last; i += stride) {
        probes_.push_back(sound(i));
    }
    probes_.push_back(sound(last));
    for (std::size_t i = 0; i + 1 < probes_.size(); ++i) {
        const std::uint32_t origin = probes_[i].point;
        std::array<double, stride + 1> way{};
        for (std::uint32_t k = origin + 1; k <= probes_[i + 1].point; ++k) {
            const Vector step(points_.x[k] - points_.x[k - 1], points_.y[k] - points_.y[k - 1]);
            way[k - origin] = way[k - origin - 1] + step.norm();
        }
        search_between(probes_[i], probes_[i + 1], way.data(), origin);
    }
}

void DeepestPointFinder::search_between(const DepthProbe& low, const DepthProbe& high,
                                        const double* way, std::uint32_t origin) {
    const std::uint32_t first = low.point + 1;
    // Depth is Lipschitz with constant 1, so these bound the depth of every point in between;
    // slightly widened for rounding.
    const double both = low.depth + high.depth;
    const double from_low_to_high = way[high.point - origin] - way[low.point - origin];
    const double slack = 4.0 * edges_->rounding + 1e-12 * (both + from_low_to_high);
    const double most = 0.5 * (both + from_low_to_high) + slack;
    const double least = 0.5 * (both - from_low_to_high) - slack;
    if (most < depth_ && least > touching_) {
        deepest_.count += high.point - first;
    } else if (is_small(*edges_) && high.point - first < simd::max_lanes) {
        // Along a straight wall all depths are equal, so bisection would not end early, and testing
        // against all of few edges at once is faster.
        look_between(first, high.point);
    } else if (first < high.point) {
        const DepthProbe middle = sound(low.point + (high.point - low.point) / 2);
        search_between(low, middle, way, origin);
        search_between(middle, high, way, origin);
    }
}

void DeepestPointFinder::look_between(std::uint32_t first, std::uint32_t end) {
    nearest_.find({end - first, points_.x + first, points_.y + first}, *edges_, 0.0);
    const simd::NearestArrays& nearest = nearest_.arrays();
    for (std::uint32_t i = first; i < end; ++i) {
        take(i, nearest.distance[i - first], nearest.edge[i - first]);
    }
}

}  // namespace nearfield::narrowphase
