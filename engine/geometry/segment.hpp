#pragma once

#include <engine/geometry/vector.hpp>

namespace nearfield::geometry {

/// The point of a segment nearest to a given point.
struct NearestOnSegment {
    Vector point;
    double parameter = 0.0;  ///< 0 at a, 1 at b
    double squared_distance = 0.0;
};

/// Returns the point of segment ab nearest to p. A zero-length segment is its point a.
[[nodiscard]] inline NearestOnSegment nearest_on_segment(const Vector& p, const Vector& a,
                                                         const Vector& b) {
    const Vector along = b - a;
    const double along_of_p = along.dot(p - a);
    const double squared_length = along.squaredNorm();
    // Both ends are returned unchanged, so that a caller can distinguish a vertex from an edge.
    if (!(along_of_p > 0.0) || squared_length == 0.0) {
        return {a, 0.0, (p - a).squaredNorm()};
    }
    if (along_of_p >= squared_length) {
        return {b, 1.0, (p - b).squaredNorm()};
    }
    const double parameter = along_of_p / squared_length;
    // Computed from the nearer end, which loses less precision.
    const Vector point =
        parameter < 0.5 ? Vector(a + parameter * along) : Vector(b - (1.0 - parameter) * along);
    return {point, parameter, (p - point).squaredNorm()};
}

/// The closest points of two segments.
struct ClosestOfSegments {
    Vector first;   ///< on the first segment
    Vector second;  ///< on the second
    double first_parameter = 0.0;
    double second_parameter = 0.0;
    double squared_distance = 0.0;
};

/// Returns the closest points of segments ab and cd: their crossing, with distance 0, if they
/// cross; any one of several closest pairs. Swapping the segments swaps the two points and leaves
/// the distance unchanged.
[[nodiscard]] ClosestOfSegments closest_of_segments(const Vector& a, const Vector& b,
                                                    const Vector& c, const Vector& d);

/// True if the closed segments ab and cd share a point; touching and overlapping count. Exact up to
/// the rounding of the orientation determinants.
[[nodiscard]] bool segments_intersect(const Vector& a, const Vector& b, const Vector& c,
                                      const Vector& d);

/// True if the closed segments ab and cd are at most `margin` apart.
[[nodiscard]] bool segments_meet(const Vector& a, const Vector& b, const Vector& c, const Vector& d,
                                 double margin);

/// Returns the least parameter (0 at a, 1 at b) at which segment ab is at most `margin` from
/// segment cd, up to a distance of `margin`; infinity if it never is. Meant for segments that are
/// on neither side of each other's line: others are not ruled out quickly.
[[nodiscard]] double first_meeting(const Vector& a, const Vector& b, const Vector& c,
                                   const Vector& d, double margin);

}  // namespace nearfield::geometry
