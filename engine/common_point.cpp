#include <engine/common_point.hpp>
#include <engine/geometry/segment.hpp>

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
    exact::EdgePair met;
    return meeting_.boundaries_meet(a, b, met)
               ? geometry::closest_of_segments(a.start(met.first), a.end(met.first),
                                               b.start(met.second), b.end(met.second))
                     .first
               : vertex_of_both(a.placed, b.placed, a.start(0));
}

}  // namespace nearfield
