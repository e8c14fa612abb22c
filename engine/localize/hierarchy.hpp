#pragma once

#include <engine/geometry/placed_polygon.hpp>
#include <engine/localize/oriented_box.hpp>
#include <nearfield/localization.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace nearfield::localize {

/// A bounding volume: a range of rings, or, further down, a range of edges of one ring.
struct Node {
    std::uint32_t ring = 0;    ///< the first ring
    std::uint32_t rings = 0;   ///< how many rings; 1 from the top of a ring's own tree downwards
    std::uint32_t first = 0;   ///< the first edge
    std::uint32_t count = 0;   ///< edges in all
    std::uint32_t height = 0;  ///< levels below the ring's own box
    geometry::Box box;
    OrientedBox oriented{};  ///< only where the hierarchy has oriented boxes
};

/// The bounding-box tree of a polygon, which is never stored: from a node the nodes below it can be
/// computed, and the caller keeps those it needs. Makes nothing in advance, so a shape may change
/// between any two uses.
class Hierarchy {
public:
    /// Rings are split at most `height` times. The polygon must outlive the hierarchy.
    Hierarchy(const geometry::PlacedPolygon& polygon, std::uint32_t height,
              BoundingVolume volume = BoundingVolume::axis_aligned)
        : polygon_(&polygon), height_(height), volume_(volume) {}

    [[nodiscard]] const geometry::PlacedPolygon& polygon() const { return *polygon_; }

    /// The node of all rings.
    [[nodiscard]] Node root();
    /// False for a leaf.
    [[nodiscard]] bool splits(const Node& node) const;
    /// Both halves of a node: of its rings, or of its edges. Precondition: it splits.
    [[nodiscard]] std::array<Node, 2> halves(const Node& node);

    /// How many boxes have been computed.
    [[nodiscard]] std::uint64_t nodes_evaluated() const { return nodes_evaluated_; }

private:
    [[nodiscard]] Node rings_node(std::uint32_t ring, std::uint32_t rings);
    [[nodiscard]] Node edges_node(const Node& parent, std::uint32_t first, std::uint32_t count);

    void add_oriented_box(Node& node);

    const geometry::PlacedPolygon* polygon_;
    std::uint32_t height_;
    BoundingVolume volume_;
    double rounding_ = 0.0;  // of oriented boxes
    std::uint64_t nodes_evaluated_ = 0;
};

/// How far rounding may have moved a vertex of a placed polygon, whose box is given. Shapes that
/// are closer than the sum of theirs cannot be told from shapes that touch.
[[nodiscard]] double placement_rounding(const geometry::PlacedPolygon& polygon,
                                        const geometry::Box& box);

/// True where two closed boxes are at most `margin` apart along both axes.
[[nodiscard]] inline bool boxes_meet(const geometry::Box& a, const geometry::Box& b,
                                     double margin) {
    return a.min().x() - margin <= b.max().x() && b.min().x() <= a.max().x() + margin &&
           a.min().y() - margin <= b.max().y() && b.min().y() <= a.max().y() + margin;
}

/// True where the bounding volumes of two nodes are at most `margin` apart: as far as their boxes,
/// and their oriented ones where both hierarchies have them, can tell.
[[nodiscard]] inline bool volumes_meet(const Node& a, const Node& b, double margin,
                                       BoundingVolume volume) {
    return boxes_meet(a.box, b.box, margin) &&
           (volume == BoundingVolume::axis_aligned || gap(a.oriented, b.oriented) <= margin);
}

/// No two points of what the bounding volumes of two nodes hold are closer than the root of this.
[[nodiscard]] inline double squared_distance(const Node& a, const Node& b, BoundingVolume volume) {
    const double squared = a.box.squaredExteriorDistance(b.box);
    if (volume == BoundingVolume::axis_aligned) {
        return squared;
    }
    const double widest = std::max(gap(a.oriented, b.oriented), 0.0);
    return std::max(squared, widest * widest);
}

}  // namespace nearfield::localize
