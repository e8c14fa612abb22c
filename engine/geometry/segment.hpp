#pragma once

#include <engine/geometry/vector.hpp>

namespace nearfield::geometry {

/// The point of a segment nearest to some point.
struct NearestOnSegment {
    Vector point;
    double parameter = 0.0;  ///< 0 at a, 1 at b
    double squared_distance = 0.0;
};

/// The point of segment ab nearest to p. A segment of no length is its point a.
[[nodiscard]] inline NearestOnSegment nearest_on_segment(const Vector& p, const Vector& a,
                                                         const Vector& b) {
    const Vector along = b - a;
    const double along_of_p = along.dot(p - a);
    const double squared_length = along.squaredNorm();
    // Both ends are returned as they are, so that a caller can tell a vertex from an edge.
    if (!(along_of_p > 0.0) || squared_length == 0.0) {
        return {a, 0.0, (p - a).squaredNorm()};
    }
    if (along_of_p >= squared_length) {
        return {b, 1.0, (p - b).squaredNorm()};
    }
    const double parameter = along_of_p / squared_length;
    // From the nearer end, where less is lost.
    const Vector point =
        parameter < 0.5 ? Vector(a + parameter * along) : Vector(b - (1.0 - parameter) * along);
    return {point, parameter, (p - point).squaredNorm()};
}

/// The points of two segments that are closest to each other.
struct ClosestOfSegments {
    Vector first;   ///< on the first segment
    Vector second;  ///< on the second
    double first_parameter = 0.0;
    double second_parameter = 0.0;
    double squared_distance = 0.0;
};

/// The closest points of segments ab and cd. Where the segments cross, the crossing, with distance
/// 0; of several closest pairs any. Swapping the segments swaps the answer's sides and leaves its
/// distance the same.
[[nodiscard]] ClosestOfSegments closest_of_segments(const Vector& a, const Vector& b,
                                                    const Vector& c, const Vector& d);

/// True where the closed segments ab and cd share a point; touching and overlapping count.
/// Exact up to the rounding of the orientation determinants.
[[nodiscard]] bool segments_intersect(const Vector& a, const Vector& b, const Vector& c,
                                      const Vector& d);

/// True where the closed segments ab and cd come as close to each other as `margin`.
[[nodiscard]] bool segments_meet(const Vector& a, const Vector& b, const Vector& c, const Vector& d,
                                 double margin);

}  // namespace nearfield::geometry
