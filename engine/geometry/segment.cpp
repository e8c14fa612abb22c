#include <engine/geometry/segment.hpp>

namespace nearfield::geometry {
namespace {

/// Which side of the line through a and b the point p is on: 1 left, -1 right, 0 on it.
int side(const Vector& a, const Vector& b, const Vector& p) {
    const double determinant = cross(b - a, p - a);
    return (determinant > 0.0 ? 1 : 0) - (determinant < 0.0 ? 1 : 0);
}

Box box_of(const Vector& a, const Vector& b) {
    return {a.cwiseMin(b), a.cwiseMax(b)};
}

}  // namespace

NearestOnSegment nearest_on_segment(const Vector& p, const Vector& a, const Vector& b) {
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

bool segments_intersect(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    // The boxes decide between segments on one line, and between points.
    if (!box_of(a, b).intersects(box_of(c, d))) {
        return false;
    }
    return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

}  // namespace nearfield::geometry
