#include <engine/base/interruption.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/narrowphase/overlap_test.hpp>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// True if a ring of `inner` lies inside `outer`, decided by one vertex of each ring. Precondition:
/// the boundaries do not intersect.
bool holds_a_ring(const simd::TransformedEdges& outer, const simd::TransformedEdges& inner) {
    const Polygon& polygon = inner.placed.polygon();
    SparseCheckpoint<64> checkpoint;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        checkpoint.step();
        const Vector vertex = inner.start(polygon.ring_begin(ring));
        if (outer.box.contains(vertex) && contains(outer, vertex)) {
            return true;
        }
    }
    return false;
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
    return intersect_without_vertex_inside(a, b) || (a.box.intersects(b.box) && holds_a_ring(b, a));
}

bool OverlapTest::intersect_without_vertex_inside(const simd::TransformedEdges& a,
                                                  const simd::TransformedEdges& b) {
    if (!localize::may_meet(a, b)) {
        return false;
    }
    // If the boundaries do not intersect, the shapes overlap only if a whole ring of one lies
    // inside the other; no ring of A lies inside B.
    simd::EdgePair ignored;
    return boundaries_meet(a, b, ignored) || holds_a_ring(a, b);
}

}  // namespace nearfield::narrowphase
