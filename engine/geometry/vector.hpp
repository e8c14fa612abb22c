#pragma once

#include <nearfield/portable_math.hpp>
#include <nearfield/shape.hpp>

// Eigen's vectors fuse products with sums where a processor can, which changes roundings. They also
// load two numbers at once that GCC 12, which makes no such vectors (cmake/modules.cmake), has just
// stored one after the other: the processor waits until both are in its cache.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

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

/// The angle from -pi/2 to pi/2 with this sine.
inline double arc_sine(double sine) {
    return arc_tangent(sine, std::sqrt((1.0 - sine) * (1.0 + sine)));
}

/// The unit vector at an angle from the x axis.
inline Vector direction(double angle) {
    const auto [sine, cosine] = sine_cosine(angle);
    return {cosine, sine};
}

inline Vector to_vector(const Vector2& v) {
    return {v.x, v.y};
}

inline Vector2 to_public(const Vector& v) {
    return {v.x(), v.y()};
}

}  // namespace nearfield::geometry
