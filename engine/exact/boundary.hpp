#pragma once

#include <engine/exact/placed_edges.hpp>
#include <engine/geometry/segment.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::exact {

/// The point of a boundary nearest to some point.
struct NearestPoint {
    std::uint32_t edge = 0;
    geometry::NearestOnSegment on_edge;
};

/// The rule of PenetrationRecord::unique: true where a point `other` of an edge makes the nearest
/// one not unique, both as near as `limit` or nearer.
[[nodiscard]] inline bool is_rival(const geometry::NearestOnSegment& other,
                                   const geometry::NearestOnSegment& nearest, double limit) {
    // How far apart two points of one straight wall can be, both within the limit.
    const double along_wall = limit * limit - nearest.squared_distance;
    return other.squared_distance <= limit * limit &&
           (other.point - nearest.point).squaredNorm() > 4.0 * along_wall;
}

/// A squared distance that is clearly more than a limit, whatever the kernels rounded.
[[nodiscard]] inline double beyond_rounding(double limit) {
    return 1.001 * limit * limit;
}

/// Exact answers about single points and one boundary, in double precision, from boxes over its
/// edges: the time grows with what lies near, not with the shape. Keeps its memory from polygon to
/// polygon.
class Boundary {
public:
    /// Complete edges, which must stay where they are as long as there are questions.
    void set(const PlacedEdges& edges);
    /// The same of edges that are placed for this alone.
    void set(const geometry::PlacedPolygon& polygon);

    [[nodiscard]] const geometry::PlacedPolygon& polygon() const { return edges_->placed; }

    /// The nearest point; of those that are equally near up to rounding any. The nearer
    /// `first_guess`, an edge, is to the point, the less is looked at.
    [[nodiscard]] NearestPoint nearest(const geometry::Vector& point,
                                       std::uint32_t first_guess = 0) const;

    /// False where another boundary point is as near to `point` as `nearest` up to `margin` and
    /// farther from it than the same straight wall explains (PenetrationRecord::unique).
    [[nodiscard]] bool is_unique(const geometry::Vector& point, const NearestPoint& nearest,
                                 double margin);

    /// By the odd-even rule; for a point on the boundary either answer may come.
    [[nodiscard]] bool contains(const geometry::Vector& point) const {
        return kernels::contain(*tree_, point.x(), point.y());
    }

    /// Keeps of some points those inside, in order, and returns how many. The nearer each is to the
    /// one before, the less is looked at.
    [[nodiscard]] std::uint32_t keep_inside(std::uint32_t count, const FoundPoints& points) const;

    /// The unit normal of an edge that points out of the polygon at a place on the edge,
    /// `parameter` of the way along it; the side changes where the boundary crosses itself. Where
    /// both sides are inside, or neither is (an even number of edges that coincide), either may
    /// come. An edge of no length gives zero.
    [[nodiscard]] geometry::Vector outward_normal(std::uint32_t edge, double parameter);

private:
    [[nodiscard]] geometry::NearestOnSegment nearest_on(std::uint32_t edge,
                                                        const geometry::Vector& point) const {
        return geometry::nearest_on_segment(point, edges_->start(edge), edges_->end(edge));
    }

    const PlacedEdges* edges_ = nullptr;
    std::optional<BoxTree> tree_;      // over them
    PlacedInstances own_;              // where they were placed for this alone
    std::vector<std::uint32_t> near_;  // edges; scratch
};

}  // namespace nearfield::exact
