#pragma once

#include <nearfield/shape.hpp>

#include <cstdint>
#include <span>
#include <vector>

/// \file The truth that worlds are compared with: rings at a pose in extended precision, and every
/// question answered by a loop over all edges. Nothing is shared with the engine.

namespace nearfield::test {

using Wide = long double;

struct WidePoint {
    Wide x = 0.0L;
    Wide y = 0.0L;
};

inline WidePoint wide(const Vector2& v) {
    return {v.x, v.y};
}

struct WideEdge {
    WidePoint from;
    WidePoint to;
};

[[nodiscard]] Wide distance_between(const WidePoint& a, const WidePoint& b);
/// The distance of a point from a closed segment.
[[nodiscard]] Wide distance_from(const WideEdge& edge, const WidePoint& p);
/// The least distance of two closed segments; 0 if they share a point.
[[nodiscard]] Wide distance_between(const WideEdge& a, const WideEdge& b);

/// How two segments cross in one point inside both.
struct Crossing {
    bool is_proper = false;
    Wide parameter = 0.0L;  ///< on the first
    Wide sine = 0.0L;       ///< of the angle between them
    Wide margin = 0.0L;     ///< the least distance of an end of one from the other segment
};
[[nodiscard]] Crossing crossing_of(const WideEdge& a, const WideEdge& b);

class PlacedRings {
public:
    /// A last vertex equal to the ring's first is dropped, as the library does.
    PlacedRings(std::span<const Ring> rings, const Pose& pose);

    [[nodiscard]] std::span<const WideEdge> edges() const { return edges_; }
    [[nodiscard]] std::span<const WidePoint> vertices() const { return vertices_; }
    /// Odd-even rule; on the boundary either answer.
    [[nodiscard]] bool contains(const WidePoint& p) const;
    [[nodiscard]] Wide distance_from_boundary(const WidePoint& p) const;
    /// Negative inside.
    [[nodiscard]] Wide signed_distance(const WidePoint& p) const;
    /// True if a closed rectangle and the closed shape (all edges count) share a point.
    [[nodiscard]] bool meets(const Rectangle& rectangle) const;
    /// The greatest depth of a vertex of `inner`; 0 if none is inside.
    [[nodiscard]] Wide deepest_vertex(const PlacedRings& inner) const;
    /// The largest coordinate, of vertices as given and as placed: what rounding is relative to.
    [[nodiscard]] double magnitude() const { return magnitude_; }

private:
    std::vector<WideEdge> edges_;
    std::vector<WidePoint> vertices_;
    double magnitude_ = 0.0;
};

}  // namespace nearfield::test
