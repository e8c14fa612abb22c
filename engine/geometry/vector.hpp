#pragma once

#include <nearfield/shape.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace nearfield::geometry {

using Vector = Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

/// z component of the cross product: twice the signed area of the triangle (0, a, b).
inline double cross(const Vector& a, const Vector& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Moves every side of a box outwards by `by`.
inline Box grown(Box box, double by) {
    box.min().array() -= by;
    box.max().array() += by;
    return box;
}

inline Vector to_vector(const Vector2& v) {
    return {v.x, v.y};
}

inline Vector2 to_public(const Vector& v) {
    return {v.x(), v.y()};
}

}  // namespace nearfield::geometry
