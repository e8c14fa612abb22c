#include <engine/geometry/segment.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/world/overlap_queries.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace nearfield::world {

using geometry::Box;
using geometry::Vector;

void OverlapQueries::begin(const Instances& instances, const WorldFilter& filter) {
    instances_ = &instances;
    filter_ = filter;
}

void OverlapQueries::find(const Vector2& point, std::vector<std::uint32_t>& found) const {
    const Vector p = geometry::to_vector(point);
    const Box search = geometry::grown(Box(p, p), instances_->max_rounding());
    instances_->boxes().for_meeting(search, [&](std::uint32_t index) {
        if (instances_->passes(index, filter_) && holds(index, p)) {
            found.push_back(index);
        }
    });
}

/// True if a point is inside, or on the boundary up to rounding.
bool OverlapQueries::holds(std::uint32_t index, const Vector& point) const {
    const simd::AabbTree& tree = instances_->tree(index);
    if (simd::kernels::contain(tree, point.x(), point.y())) {
        return true;
    }
    const double rounding = instances_->rounding(index);
    const double most =
        std::nextafter(rounding * rounding, std::numeric_limits<double>::infinity());
    constexpr std::uint32_t none = UINT32_MAX;
    return simd::kernels::find_nearer(tree, point.x(), point.y(), {none, most}).edge != none;
}

/// True if an edge comes into the rectangle, or the rectangle lies inside.
bool OverlapQueries::meets(std::uint32_t index, const Box& box) const {
    const simd::TransformedEdges& edges = instances_->edges(index);
    const simd::AabbTree& tree = instances_->tree(index);
    const std::array<Vector, 4> corners{box.min(), box.corner(Box::BottomRight), box.max(),
                                        box.corner(Box::TopLeft)};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector& from = corners[i];
        const Vector& to = corners[(i + 1) % corners.size()];
        struct Side {
            const Vector& from;
            const Vector& to;
            const simd::TransformedEdges& edges;
            bool meets;
        } side{from, to, edges, false};
        const auto use = [](void* user, std::uint32_t edge) {
            Side& of = *static_cast<Side*>(user);
            of.meets = of.meets || geometry::segments_meet(of.from, of.to, of.edges.start(edge),
                                                           of.edges.end(edge), of.edges.rounding);
            return of.meets ? -1.0 : 1.0;
        };
        simd::kernels::for_edges_along(tree, {from.x(), from.y(), to.x(), to.y()}, edges.rounding,
                                       1.0, {use, &side});
        if (side.meets) {
            return true;
        }
    }
    // No edge crosses the rectangle's sides: each ring lies inside or outside of them.
    const geometry::Polygon& polygon = instances_->polygon(index);
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        if (box.contains(edges.start(polygon.ring_begin(ring)))) {
            return true;
        }
    }
    return simd::kernels::contain(tree, box.min().x(), box.min().y());
}

void OverlapQueries::find(const Rectangle& rectangle, std::vector<std::uint32_t>& found) const {
    const Box box(geometry::to_vector(rectangle.min), geometry::to_vector(rectangle.max));
    const Box search = geometry::grown(box, instances_->max_rounding());
    instances_->boxes().for_meeting(search, [&](std::uint32_t index) {
        const double rounding = instances_->rounding(index);
        if (instances_->passes(index, filter_) &&
            localize::boxes_meet(instances_->box(index), box, rounding) && meets(index, box)) {
            found.push_back(index);
        }
    });
}

}  // namespace nearfield::world
