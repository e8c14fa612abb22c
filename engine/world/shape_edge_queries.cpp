#include <engine/geometry/segment.hpp>
#include <engine/simd/ordered_search.hpp>
#include <engine/world/shape_edge_queries.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::world {
namespace {

using geometry::Vector;

constexpr double unit_of_one = std::numeric_limits<double>::epsilon();
constexpr double far_away = std::numeric_limits<double>::infinity();

/// The closest points of an edge and a boundary that does not hold the edge.
struct Closest {
    Vector on_boundary = Vector::Zero();
    Vector on_edge = Vector::Zero();
    double squared = far_away;
    std::uint32_t boundary_edge = UINT32_MAX;
};

/// Looks no farther than the square root of `most`.
Closest find_closest(const simd::TransformedEdges& boundary, const Vector& start, const Vector& end,
                     double most) {
    Closest closest;
    geometry::Box box(start.cwiseMin(end), start.cwiseMax(end));
    const simd::AabbTree tree = boundary.tree();
    simd::for_edges_near(
        tree, geometry::extent_of(box),
        [&] { return std::min(most, (1.0 + 16.0 * unit_of_one) * closest.squared); },
        [&](std::uint32_t edge) {
            const geometry::ClosestOfSegments found =
                geometry::closest_of_segments(boundary.start(edge), boundary.end(edge), start, end);
            // Of equally close ones the first, in whatever order they come.
            if (found.squared_distance < closest.squared ||
                (found.squared_distance == closest.squared && edge < closest.boundary_edge)) {
                closest = {found.first, found.second, found.squared_distance, edge};
            }
        });
    return closest;
}

}  // namespace

void ShapeEdgeQueries::begin(const Instances& instances, const WorldFilter& filter) {
    instances_ = &instances;
    filter_ = filter;
}

void ShapeEdgeQueries::measure(std::uint32_t index, std::uint32_t edge) {
    const simd::TransformedEdges& edges = instances_->edges(index);
    const Vector start = edges.start(edge);
    Found found{{0.0, instances_->number(index), index, edge}, start, start};
    const bool is_inside =
        shape().box.contains(start) && simd::kernels::contain(shape().tree(), start.x(), start.y());
    if (!is_inside) {
        const Closest closest =
            find_closest(shape(), start, edges.end(edge),
                         nearest_.squared_reach(edges.rounding + shape().rounding));
        if (closest.squared == far_away) {
            return;
        }
        found.distance = std::sqrt(closest.squared);
        found.point = closest.on_boundary;
        found.nearest = closest.on_edge;
    }
    nearest_.offer(found);
}

void ShapeEdgeQueries::find_edges_of(std::uint32_t index) {
    const simd::AabbTree& tree = instances_->tree(index);
    const double rounding = instances_->rounding(index) + shape().rounding;
    simd::for_edges_near(
        tree, geometry::extent_of(shape().box), [&] { return nearest_.squared_reach(rounding); },
        [&](std::uint32_t edge) { measure(index, edge); });
}

ShapeEdgeHit ShapeEdgeQueries::hit_of(const Found& found) const {
    const double rounding = shape().rounding + instances_->rounding(found.instance);
    ShapeEdgeHit hit;
    hit.instance = instances_->handle(found.instance);
    hit.edge = found.edge;
    hit.distance = found.distance;
    hit.error_bound = rounding + shape().placed.polygon().deviation() +
                      instances_->deviation(found.instance) + 8.0 * unit_of_one * found.distance;
    hit.point = geometry::to_public(found.point);
    hit.nearest = geometry::to_public(found.nearest);
    if (found.distance > 0.0) {
        hit.direction = geometry::to_public((found.nearest - found.point) / found.distance);
    }
    return hit;
}

void ShapeEdgeQueries::find(const geometry::TransformedPolygon& placed, double max_distance,
                            std::span<ShapeEdgeHit> hits) {
    shape_edges_.place_alone(placed);
    shape_edges_.prepare(0);
    nearest_.begin(hits.size(), max_distance);
    const double rounding = shape().rounding + instances_->max_rounding();
    instances_->boxes().for_near(
        shape().box, [&] { return nearest_.squared_reach(rounding); },
        [&](std::uint32_t index, double) {
            if (instances_->passes(index, filter_)) {
                find_edges_of(index);
            }
        });
    std::fill(hits.begin(), hits.end(), ShapeEdgeHit{});
    std::transform(nearest_.found().begin(), nearest_.found().end(), hits.begin(),
                   [this](const Found& found) { return hit_of(found); });
}

}  // namespace nearfield::world
