#include <engine/base/interruption.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/overlap_test.hpp>

#include <optional>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// A vertex of a ring of `inner` that lies inside `outer`, if there is such a ring; one vertex of
/// each decides. Precondition: the boundaries do not intersect.
std::optional<Vector> vertex_inside(const simd::TransformedEdges& inner,
                                    const simd::TransformedEdges& outer) {
    const Polygon& polygon = inner.placed.polygon();
    SparseCheckpoint<64> checkpoint;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        checkpoint.step();
        const Vector vertex = inner.start(polygon.ring_begin(ring));
        if (outer.box.contains(vertex) && contains(outer, vertex)) {
            return vertex;
        }
    }
    return std::nullopt;
}

}  // namespace

bool OverlapTest::boundaries_meet(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                  simd::EdgePair& edges) {
    const double margin = a.rounding + b.rounding;
    return pairs_.for_each(a, b, [&](const simd::EdgePair& pair) {
        edges = pair;
        return !geometry::segments_meet(a.start(pair.first), a.end(pair.first),
                                        b.start(pair.second), b.end(pair.second), margin);
    });
}

bool OverlapTest::intersect(const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
    return intersect_without_vertex_inside(a, b) ||
           (a.box.intersects(b.box) && vertex_inside(a, b));
}

bool OverlapTest::intersect_without_vertex_inside(const simd::TransformedEdges& a,
                                                  const simd::TransformedEdges& b) {
    if (!geometry::may_meet(a, b)) {
        return false;
    }
    // If the boundaries do not intersect, the shapes overlap only if a whole ring of one lies
    // inside the other; no ring of A lies inside B.
    simd::EdgePair ignored;
    return boundaries_meet(a, b, ignored) || vertex_inside(b, a);
}

Vector OverlapTest::common_point(const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
    simd::EdgePair met;
    if (boundaries_meet(a, b, met)) {
        return geometry::closest_of_segments(a.start(met.first), a.end(met.first),
                                             b.start(met.second), b.end(met.second))
            .first;
    }
    const std::optional<Vector> of_a = vertex_inside(a, b);
    return of_a ? *of_a : vertex_inside(b, a).value_or(a.start(0));
}

}  // namespace nearfield::narrowphase
