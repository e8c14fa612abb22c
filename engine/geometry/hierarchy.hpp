#pragma once

#include <engine/geometry/oriented_box.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <nearfield/localization.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace nearfield::geometry {

/// A node of the bounding-volume hierarchy: a range of rings or, further down, a range of edges of
/// one ring.
struct Node {
    std::uint32_t ring = 0;    ///< the first ring
    std::uint32_t rings = 0;   ///< number of rings; 1 from the top of a ring's own tree down
    std::uint32_t first = 0;   ///< the first edge
    std::uint32_t count = 0;   ///< edges in all
    std::uint32_t height = 0;  ///< levels below the ring's own box
    Box box;
    OrientedBox oriented{};  ///< only if the hierarchy has oriented boxes
};

/// The bounding-volume hierarchy of a polygon, which is never stored: the children of a node are
/// computed from it, and the caller keeps those it needs. Nothing is precomputed, so a shape may
/// change between any two uses.
class Hierarchy {
public:
    /// Rings are split at most `height` times. The polygon must outlive the hierarchy.
    Hierarchy(const TransformedPolygon& polygon, std::uint32_t height,
              BoundingVolume volume = BoundingVolume::axis_aligned)
        : polygon_(&polygon), height_(height), volume_(volume) {}

    [[nodiscard]] const TransformedPolygon& polygon() const { return *polygon_; }

    /// The node of all rings.
    [[nodiscard]] Node root();
    /// False for a leaf.
    [[nodiscard]] bool splits(const Node& node) const;
    /// Both halves of a node: of its rings, or of its edges. Precondition: splits(node).
    [[nodiscard]] std::array<Node, 2> halves(const Node& node);

    /// The number of bounding volumes computed.
    [[nodiscard]] std::uint64_t nodes_evaluated() const { return nodes_evaluated_; }

private:
    [[nodiscard]] Node rings_node(std::uint32_t ring, std::uint32_t rings);
    [[nodiscard]] Node edges_node(const Node& parent, std::uint32_t first, std::uint32_t count);

    void add_oriented_box(Node& node);

    const TransformedPolygon* polygon_;
    std::uint32_t height_;
    BoundingVolume volume_;
    double rounding_ = 0.0;  // of oriented boxes
    std::uint64_t nodes_evaluated_ = 0;
};

/// Bounds the distance by which rounding may have moved a vertex of a transformed polygon, given
/// its box. Shapes closer than the sum of their bounds cannot be distinguished from touching
/// shapes.
[[nodiscard]] double placement_rounding(const TransformedPolygon& polygon, const Box& box);

/// True if two closed boxes are at most `margin` apart along both axes.
[[nodiscard]] inline bool boxes_meet(const Box& a, const Box& b, double margin) {
    return a.min().x() - margin <= b.max().x() && b.min().x() <= a.max().x() + margin &&
           a.min().y() - margin <= b.max().y() && b.min().y() <= a.max().y() + margin;
}

/// Where a shape is at its pose.
struct Bounds {
    Box box;                ///< of the vertices as they are computed
    double rounding = 0.0;  ///< of these vertices: placement_rounding()
};

[[nodiscard]] inline Bounds bounds_of(const TransformedPolygon& polygon) {
    const Box box = polygon.box();
    return {box, placement_rounding(polygon, box)};
}

/// Whether shapes can be at most `reach` apart, by their boxes. Shapes count as touching up to the
/// rounding of their vertices, so boxes do as well: whoever looks for pairs of shapes compares
/// their boxes by this function, or finds all that it would and then calls it, or else has pairs
/// that another has not. `A` and `B` have a `box` and its `rounding`, as Bounds does.
template <class A, class B>
[[nodiscard]] bool may_meet(const A& a, const B& b, double reach = 0.0) {
    return boxes_meet(a.box, b.box, reach + (a.rounding + b.rounding));
}

/// True if the bounding volumes of two nodes may be at most `margin` apart, judged by their boxes
/// and, if both hierarchies have them, their oriented boxes.
[[nodiscard]] inline bool volumes_meet(const Node& a, const Node& b, double margin,
                                       BoundingVolume volume) {
    return boxes_meet(a.box, b.box, margin) &&
           (volume == BoundingVolume::axis_aligned || gap(a.oriented, b.oriented) <= margin);
}

/// A squared lower bound on the distance between the contents of two nodes.
[[nodiscard]] inline double squared_distance(const Node& a, const Node& b, BoundingVolume volume) {
    const double squared = a.box.squaredExteriorDistance(b.box);
    if (volume == BoundingVolume::axis_aligned) {
        return squared;
    }
    const double widest = std::max(gap(a.oriented, b.oriented), 0.0);
    return std::max(squared, widest * widest);
}

}  // namespace nearfield::geometry
