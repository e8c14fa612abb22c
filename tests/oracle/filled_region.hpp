#pragma once

#include <nearfield/fill.hpp>
#include <nearfield/shape.hpp>

#include <tests/oracle/edge_tree.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace nearfield::oracle {

/// The region that rings enclose by a fill rule, by brute force: every edge is cut where others
/// cross or touch it, and a piece is boundary if winding numbers put its sides on different sides
/// of the region. Shares no code with resolve_fill().
///
/// Works to 10^-12 of the rings' extent: pieces shorter than that are left out, and parts and gaps
/// narrower than that may be.
class FilledRegion {
public:
    /// Of FillRule::union_of_parts every ring is a part.
    FilledRegion(std::span<const Ring> rings, FillRule rule);

    /// The pieces of edges that are boundary, in no order.
    [[nodiscard]] std::vector<Edge> boundary() const { return placed(boundary_); }
    /// The pieces of edges with the region on both sides.
    [[nodiscard]] std::vector<Edge> inner_edges() const { return placed(inner_); }

    /// On an edge either answer.
    [[nodiscard]] bool contains(const Vector2& point) const;
    /// The distance to the boundary.
    [[nodiscard]] double distance(const Vector2& point) const;
    /// Negative inside.
    [[nodiscard]] double signed_distance(const Vector2& point) const;
    /// How far off these answers may be.
    [[nodiscard]] double resolution() const { return resolution_; }

private:
    [[nodiscard]] std::vector<Edge> placed(std::vector<Edge> edges) const;
    [[nodiscard]] bool has(const Vector2& local) const;
    void add_pieces(const Edge& edge);
    void add_piece(const Vector2& from, const Vector2& to);

    FillRule rule_;
    double resolution_ = 0.0;
    Vector2 origin_;  // the first vertex, to which everything below is relative
    std::vector<std::vector<Edge>> edges_;  // of each ring
    std::vector<Edge> boundary_;
    std::vector<Edge> inner_;
};

}  // namespace nearfield::oracle
