#pragma once

#include <nearfield/shape.hpp>

#include <cmath>

/// \file Arithmetic on points and directions in the plane.

namespace nearfield::simulation {

[[nodiscard]] inline Vector2 operator+(Vector2 a, Vector2 b) {
    return {a.x + b.x, a.y + b.y};
}
[[nodiscard]] inline Vector2 operator-(Vector2 a, Vector2 b) {
    return {a.x - b.x, a.y - b.y};
}
[[nodiscard]] inline Vector2 operator-(Vector2 a) {
    return {-a.x, -a.y};
}
[[nodiscard]] inline Vector2 operator*(double factor, Vector2 a) {
    return {factor * a.x, factor * a.y};
}
inline Vector2& operator+=(Vector2& a, Vector2 b) {
    return a = a + b;
}
inline Vector2& operator-=(Vector2& a, Vector2 b) {
    return a = a - b;
}

[[nodiscard]] inline double dot(Vector2 a, Vector2 b) {
    return a.x * b.x + a.y * b.y;
}
/// The z component of the cross product.
[[nodiscard]] inline double cross(Vector2 a, Vector2 b) {
    return a.x * b.y - a.y * b.x;
}
[[nodiscard]] inline double length(Vector2 a) {
    return std::hypot(a.x, a.y);
}
/// Rotates by a quarter turn counter-clockwise.
[[nodiscard]] inline Vector2 left_of(Vector2 a) {
    return {-a.y, a.x};
}
[[nodiscard]] inline Vector2 polar(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle)};
}
[[nodiscard]] inline Vector2 rotated(Vector2 a, double angle) {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y};
}
/// Transforms a point from shape coordinates to world coordinates.
[[nodiscard]] inline Vector2 placed(const Pose& pose, Vector2 point) {
    return pose.translation + rotated(point, pose.angle);
}

}  // namespace nearfield::simulation
