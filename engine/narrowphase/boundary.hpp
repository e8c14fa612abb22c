#pragma once

#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/ray_parities.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::narrowphase {

/// The point of a boundary nearest to a given point.
struct NearestPoint {
    std::uint32_t edge = 0;
    geometry::NearestOnSegment on_edge;
};

/// Implements PenetratingPoint::unique: true if a point `other` of an edge makes the nearest one
/// not unique. Both are at most `limit` away.
[[nodiscard]] inline bool is_rival(const geometry::NearestOnSegment& other,
                                   const geometry::NearestOnSegment& nearest, double limit) {
    // The squared half-length of the part of a straight wall that lies within the limit.
    const double along_wall = limit * limit - nearest.squared_distance;
    return other.squared_distance <= limit * limit &&
           (other.point - nearest.point).squaredNorm() > 4.0 * along_wall;
}

/// An outward normal that has been asked for.
struct AskedNormal {
    geometry::Vector left = geometry::Vector::Zero();  ///< the normal, or its opposite
    bool left_is_ahead = true;
    RayParities::Ticket inside_ahead = RayParities::even;
};

/// Exact queries for single points and one boundary, in double precision, with an AABB tree over
/// its edges: the time grows with the nearby features, not with the shape. Reuses its memory
/// between polygons.
class Boundary {
public:
    /// `edges` must be complete, and must stay in place as long as the boundary is queried.
    void set(const simd::TransformedEdges& edges);
    /// The same for a polygon whose edges are transformed and owned by this object.
    void set(const geometry::TransformedPolygon& polygon);

    [[nodiscard]] const geometry::TransformedPolygon& polygon() const { return edges_->placed; }

    /// Returns the nearest boundary point; any of those equally near up to rounding. The nearer the
    /// edge `first_guess` is to the point, the faster the search.
    [[nodiscard]] NearestPoint nearest(const geometry::Vector& point,
                                       std::uint32_t first_guess = 0) const;

    /// False if another boundary point is as near to `point` as `nearest`, up to `margin`, and
    /// farther from `nearest` than one straight wall explains (PenetratingPoint::unique).
    [[nodiscard]] bool is_unique(const geometry::Vector& point, const NearestPoint& nearest,
                                 double margin);

    /// Even-odd rule; unspecified for points on the boundary.
    [[nodiscard]] bool contains(const geometry::Vector& point) const {
        return simd::kernels::contain(*tree_, point.x(), point.y());
    }

    /// Keeps only the points inside, in order, and returns their number. The nearer each point is
    /// to the one before, the faster.
    [[nodiscard]] std::uint32_t keep_inside(std::uint32_t count, const simd::FoundPoints& points);

    /// Returns the unit normal of an edge that points out of the polygon at `parameter` along the
    /// edge; the side changes where the boundary crosses itself. Unspecified if both sides are
    /// inside, or neither is (an even number of coincident edges). Zero for a zero-length edge.
    [[nodiscard]] AskedNormal ask_outward_normal(std::uint32_t edge, double parameter);
    /// Answers what has been asked; many at once take less time than one by one.
    void answer_asked() { parities_.answer(); }
    /// Precondition: answer_asked() has been called since, and the boundary is the same.
    [[nodiscard]] geometry::Vector outward_normal(const AskedNormal& asked) const {
        const bool left_is_inside = parities_.is_odd(asked.inside_ahead) == asked.left_is_ahead;
        return left_is_inside ? geometry::Vector(-asked.left) : asked.left;
    }

private:
    [[nodiscard]] geometry::NearestOnSegment nearest_on(std::uint32_t edge,
                                                        const geometry::Vector& point) const {
        return geometry::nearest_on_segment(point, edges_->start(edge), edges_->end(edge));
    }

    const simd::TransformedEdges* edges_ = nullptr;
    std::optional<simd::AabbTree> tree_;  // over edges_
    simd::TransformedInstances own_;      // the edges of set(TransformedPolygon)
    RayParities parities_;
    std::vector<std::uint32_t> near_;           // scratch: edges
    std::vector<RayParities::Ticket> tickets_;  // scratch: by point
};

}  // namespace nearfield::narrowphase
