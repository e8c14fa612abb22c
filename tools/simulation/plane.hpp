#pragma once

#include <nearfield/portable_math.hpp>
#include <nearfield/shape.hpp>

#include <cmath>

/// \file Arithmetic on points and directions in the plane, with the same bits on every machine.

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
    return std::sqrt(dot(a, a));
}
/// Rotates by a quarter turn counter-clockwise.
[[nodiscard]] inline Vector2 left_of(Vector2 a) {
    return {-a.y, a.x};
}
[[nodiscard]] inline Vector2 polar(double radius, double angle) {
    const auto [sine, cosine] = sine_cosine(angle);
    return {radius * cosine, radius * sine};
}
[[nodiscard]] inline Vector2 rotated(Vector2 a, double angle) {
    const auto [sine, cosine] = sine_cosine(angle);
    return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y};
}
/// Transforms a point from shape coordinates to world coordinates.
[[nodiscard]] inline Vector2 placed(const Pose& pose, Vector2 point) {
    return pose.translation + rotated(point, pose.angle);
}

}  // namespace nearfield::simulation
