#include <engine/exact/meeting.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/hierarchy.hpp>

namespace nearfield::exact {
namespace {

using geometry::Box;
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

bool edges_meet(const PlacedEdges& a, const PlacedEdges& b, const EdgePair& edges) {
    return geometry::segments_meet(a.start(edges.first), a.end(edges.first), b.start(edges.second),
                                   b.end(edges.second), a.rounding + b.rounding);
}

/// By boxes over the edges of both.
bool large_boundaries_meet(const PlacedEdges& a, const PlacedEdges& b, EdgePair& edges) {
    struct Search {
        const PlacedEdges& a;
        const PlacedEdges& b;
        EdgePair& met;
    } search{a, b, edges};
    const auto look = [](void* user, const EdgePair& pair) {
        Search& at = *static_cast<Search*>(user);
        if (edges_meet(at.a, at.b, pair)) {
            at.met = pair;
            return false;
        }
        return true;
    };
    return kernels::for_meeting_pairs(a.tree(), b.tree(), a.rounding + b.rounding, {look, &search});
}

}  // namespace

bool MeetingFinder::boundaries_meet(const PlacedEdges& a, const PlacedEdges& b, EdgePair& edges) {
    return is_small(a) && is_small(b) ? small_boundaries_meet(a, b, edges)
                                      : large_boundaries_meet(a, b, edges);
}

bool MeetingFinder::small_boundaries_meet(const PlacedEdges& a, const PlacedEdges& b,
                                          EdgePair& edges) {
    const double margin = a.rounding + b.rounding;
    Box common = a.box.intersection(b.box);
    common.min().array() -= 2.0 * margin;
    common.max().array() += 2.0 * margin;
    of_a_.pick(a, extent_of(common));
    if (of_a_.empty()) {
        return false;
    }
    of_b_.pick(b, extent_of(common));
    if (of_b_.empty()) {
        return false;
    }
    const EdgeArrays picked_a = of_a_.edges();
    const EdgeArrays picked_b = of_b_.edges();
    EdgePair pair;
    while (kernels::find_meeting_pair(picked_a, picked_b, margin, pair)) {
        edges = {of_a_.index(pair.first), of_b_.index(pair.second)};
        if (edges_meet(a, b, edges)) {
            return true;
        }
        ++pair.second;
    }
    return false;
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
