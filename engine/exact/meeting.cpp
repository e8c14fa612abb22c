#include <engine/exact/meeting.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/hierarchy.hpp>

namespace nearfield::exact {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// True where a ring of `inner` lies in `outer`, told by one vertex of each: their boundaries do
/// not meet.
bool holds_a_ring(const PlacedEdges& outer, const PlacedEdges& inner) {
    const Polygon& polygon = inner.placed.polygon();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const Vector vertex = inner.start(polygon.ring_begin(ring));
        if (outer.box.contains(vertex) && contains(outer, vertex)) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool MeetingFinder::boundaries_meet(const PlacedEdges& a, const PlacedEdges& b, EdgePair& edges) {
    const double margin = a.rounding + b.rounding;
    return pairs_.for_each(a, b, [&](const EdgePair& pair) {
        edges = pair;
        return !geometry::segments_meet(a.start(pair.first), a.end(pair.first),
                                        b.start(pair.second), b.end(pair.second), margin);
    });
}

bool MeetingFinder::intersect(const PlacedEdges& a, const PlacedEdges& b) {
    return intersect_without_vertex_inside(a, b) || (a.box.intersects(b.box) && holds_a_ring(b, a));
}

bool MeetingFinder::intersect_without_vertex_inside(const PlacedEdges& a, const PlacedEdges& b) {
    if (!localize::boxes_meet(a.box, b.box, a.rounding + b.rounding)) {
        return false;
    }
    // Without contact a whole ring of one shape lies in the other, or none does; and none of A.
    EdgePair ignored;
    return boundaries_meet(a, b, ignored) || holds_a_ring(a, b);
}

}  // namespace nearfield::exact
