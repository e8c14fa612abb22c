#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace nearfield::oracle {

/// A segment of a boundary.
struct Edge {
    Vector2 from;
    Vector2 to;
};

/// A bounding box tree over edges, so that dense checks against long boundaries stay affordable. It
/// only excludes edges that cannot matter; the caller handles the others.
class EdgeTree {
public:
    explicit EdgeTree(std::vector<Edge> edges);

    [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
    /// The bounding box of all edges.
    [[nodiscard]] const Rectangle& box() const { return nodes_.front().box; }

    /// Calls `visit(edge)` for every edge whose box overlaps `box`, boundaries included.
    void visit_box(const Rectangle& box, const std::function<void(std::uint32_t)>& visit) const;

    /// Calls `visit(edge)`, nearer boxes first, for every edge whose box is no farther from `point`
    /// than the minimum distance that `visit` has returned so far (initially `reach`).
    void visit_nearest(const Vector2& point, double reach,
                       const std::function<double(std::uint32_t)>& visit) const;

private:
    struct Node {
        Rectangle box;
        std::uint32_t first = 0;
        std::uint32_t count =
            0;  // edges of a leaf; 0: an inner node with children first, first + 1
    };
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t last);
    void descend(std::uint32_t node, const Vector2& point, double& reach,
                 const std::function<double(std::uint32_t)>& visit) const;

    std::vector<Edge> edges_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace nearfield::oracle
