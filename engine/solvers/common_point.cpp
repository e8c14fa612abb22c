#include <engine/base/interruption.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/solvers/common_point.hpp>

#include <optional>

namespace nearfield::solvers {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;
using simd::TransformedEdges;

/// A vertex of `inner` that lies inside `outer`, if a whole ring of it does.
std::optional<Vector> vertex_inside(const TransformedPolygon& inner,
                                    const TransformedPolygon& outer) {
    const geometry::Polygon& polygon = inner.polygon();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        checkpoint();
        const Vector vertex = inner.vertex(polygon.ring_begin(ring));
        if (contains(outer, vertex)) {
            return vertex;
        }
    }
    return std::nullopt;
}

/// A vertex of either shape inside the other; `otherwise` if there is none.
Vector vertex_of_both(const TransformedPolygon& a, const TransformedPolygon& b,
                      const Vector& otherwise) {
    for (const auto& vertex : {vertex_inside(a, b), vertex_inside(b, a)}) {
        if (vertex) {
            return *vertex;
        }
    }
    return otherwise;
}

}  // namespace

Vector CommonPoint::find(const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
    simd::EdgePair met;
    return overlap_test_.boundaries_meet(a, b, met)
               ? geometry::closest_of_segments(a.start(met.first), a.end(met.first),
                                               b.start(met.second), b.end(met.second))
                     .first
               : vertex_of_both(a.placed, b.placed, a.start(0));
}

}  // namespace nearfield::solvers
