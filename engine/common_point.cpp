#include <engine/common_point.hpp>
#include <engine/geometry/segment.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace nearfield {
namespace {

using exact::PlacedEdges;
using geometry::PlacedPolygon;
using geometry::Vector;

/// A vertex of `inner` that lies in `outer`, where a ring of it does.
std::optional<Vector> vertex_inside(const PlacedPolygon& inner, const PlacedPolygon& outer) {
    const geometry::Polygon& polygon = inner.polygon();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const Vector vertex = inner.vertex(polygon.ring_begin(ring));
        if (contains(outer, vertex)) {
            return vertex;
        }
    }
    return std::nullopt;
}

/// A vertex of either shape in the other; `otherwise` where there is none.
Vector vertex_of_both(const PlacedPolygon& a, const PlacedPolygon& b, const Vector& otherwise) {
    for (const auto& vertex : {vertex_inside(a, b), vertex_inside(b, a)}) {
        if (vertex) {
            return *vertex;
        }
    }
    return otherwise;
}

}  // namespace

Vector CommonPoint::find(const PlacedEdges& a, const PlacedEdges& b) {
    if (!is_small(a) || !is_small(b)) {
        return find(a.placed, b.placed, a.rounding + b.rounding);
    }
    exact::EdgePair met;
    return meeting_.boundaries_meet(a, b, met)
               ? geometry::closest_of_segments(a.start(met.first), a.end(met.first),
                                               b.start(met.second), b.end(met.second))
                     .first
               : vertex_of_both(a.placed, b.placed, a.start(0));
}

Vector CommonPoint::find(const PlacedPolygon& a, const PlacedPolygon& b, double rounding) {
    const exact::ClosestPair closest = finder_.find(a, b, std::numeric_limits<double>::infinity());
    const bool boundaries_meet = std::sqrt(closest.squared_distance) <= rounding;
    return boundaries_meet ? closest.point_a : vertex_of_both(a, b, closest.point_a);
}

}  // namespace nearfield
