#include <engine/base/interruption.hpp>
#include <engine/geometry/containment.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/localize/overlap.hpp>

#include <array>
#include <cstdint>
#include <limits>

namespace nearfield::localize {
namespace {

using geometry::Box;
using geometry::Polygon;
using geometry::segments_meet;
using geometry::TransformedPolygon;
using geometry::Vector;

/// Pairs with this few edges are tested by brute force: computing smaller boxes would cost as much.
constexpr std::uint32_t leaf_edges = 8;

/// The vertices of a leaf's edges in the world.
struct Leaf {
    std::array<Vector, leaf_edges + 1> vertices;
    std::uint32_t edges = 0;

    Leaf(const TransformedPolygon& placed, const Node& node) : edges(node.count) {
        const Polygon& polygon = placed.polygon();
        const std::uint32_t last = node.first + node.count;
        for (std::uint32_t i = node.first; i < last; ++i) {
            vertices[i - node.first] = placed.vertex(i);
        }
        const bool wraps = last == polygon.ring_end(node.ring);
        vertices[edges] = placed.vertex(wraps ? polygon.ring_begin(node.ring) : last);
    }

    [[nodiscard]] Box box(std::uint32_t edge) const {
        return {vertices[edge].cwiseMin(vertices[edge + 1]),
                vertices[edge].cwiseMax(vertices[edge + 1])};
    }
};

class BoundaryContact {
public:
    BoundaryContact(Hierarchy& a, Hierarchy& b, double margin, BoundingVolume volume)
        : a_(a), b_(b), margin_(margin), volume_(volume) {}

    /// True if edges of the two nodes intersect.
    [[nodiscard]] bool meet(const Node& a, const Node& b) {
        checkpoint_.step();
        if (!volumes_meet(a, b, margin_, volume_)) {
            ++pairs_rejected_;
            return false;
        }
        const bool leaf_a = is_leaf(a);
        const bool leaf_b = is_leaf(b);
        if (leaf_a && leaf_b) {
            return leaves_meet(Leaf(a_.polygon(), a), Leaf(b_.polygon(), b));
        }
        // Split the larger node first: both shrink together, and few boxes are computed twice.
        if (leaf_b || (!leaf_a && a.count >= b.count)) {
            const std::array<Node, 2> halves = a_.halves(a);
            return meet(halves[0], b) || meet(halves[1], b);
        }
        const std::array<Node, 2> halves = b_.halves(b);
        return meet(a, halves[0]) || meet(a, halves[1]);
    }

    [[nodiscard]] std::uint64_t pairs_rejected() const { return pairs_rejected_; }

private:
    static bool is_leaf(const Node& node) { return node.rings == 1 && node.count <= leaf_edges; }

    [[nodiscard]] bool leaves_meet(const Leaf& a, const Leaf& b) const {
        for (std::uint32_t i = 0; i < a.edges; ++i) {
            const Box box = a.box(i);
            for (std::uint32_t j = 0; j < b.edges; ++j) {
                if (boxes_meet(box, b.box(j), margin_) &&
                    segments_meet(a.vertices[i], a.vertices[i + 1], b.vertices[j],
                                  b.vertices[j + 1], margin_)) {
                    return true;
                }
            }
        }
        return false;
    }

    Hierarchy& a_;
    Hierarchy& b_;
    double margin_;
    BoundingVolume volume_;
    std::uint64_t pairs_rejected_ = 0;
    SparseCheckpoint<256> checkpoint_;
};

/// True if a ring of `inner` lies inside `outer`, decided by one vertex of each ring. Precondition:
/// the boundaries do not intersect.
bool any_ring_inside(const TransformedPolygon& inner, const TransformedPolygon& outer,
                     const Box& outer_box) {
    // Kept per thread, so that the steady state allocates nothing.
    thread_local geometry::Containment containment;
    containment.clear();
    const Polygon& polygon = inner.polygon();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const Vector vertex = inner.vertex(polygon.ring_begin(ring));
        if (outer_box.contains(vertex)) {
            containment.ask(vertex);
        }
    }
    containment.answer(outer);
    return containment.any_inside();
}

}  // namespace

bool intersects(const TransformedPolygon& a, const TransformedPolygon& b, BoundingVolume volume,
                Effort* effort) {
    constexpr std::uint32_t no_limit = std::numeric_limits<std::uint32_t>::max();
    Hierarchy tree_a(a, no_limit, volume);
    Hierarchy tree_b(b, no_limit, volume);
    const Node root_a = tree_a.root();
    const Node root_b = tree_b.root();
    const double margin = placement_rounding(a, root_a.box) + placement_rounding(b, root_b.box);
    BoundaryContact contact(tree_a, tree_b, margin, volume);
    const bool boundaries_meet = contact.meet(root_a, root_b);
    if (effort != nullptr) {
        *effort += {tree_a.nodes_evaluated() + tree_b.nodes_evaluated(), contact.pairs_rejected()};
    }
    if (boundaries_meet || !boxes_meet(root_a.box, root_b.box, margin)) {
        return boundaries_meet;
    }
    // The boundaries do not intersect. If the shapes shared a point, they would share a boundary
    // point of their intersection, so a whole ring of one would lie inside the other.
    return any_ring_inside(a, b, root_b.box) || any_ring_inside(b, a, root_a.box);
}

}  // namespace nearfield::localize
