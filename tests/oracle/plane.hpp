#pragma once

#include <nearfield/shape.hpp>

#include <cmath>

/// \file The few point operations that the oracle needs. They are its own, so that it shares no
/// arithmetic with the code it checks.

namespace nearfield::oracle {

inline Vector2 plus(const Vector2& a, const Vector2& b) {
    return {a.x + b.x, a.y + b.y};
}

inline Vector2 minus(const Vector2& a, const Vector2& b) {
    return {a.x - b.x, a.y - b.y};
}

inline Vector2 times(const Vector2& a, double factor) {
    return {a.x * factor, a.y * factor};
}

inline double dot(const Vector2& a, const Vector2& b) {
    return a.x * b.x + a.y * b.y;
}

/// To a rounding or two, of lengths from 1e-150 to 1e150.
inline double length(const Vector2& a) {
    return std::sqrt(dot(a, a));
}

inline double distance(const Vector2& a, const Vector2& b) {
    return length(minus(a, b));
}

/// Twice the signed area of triangle abc, in extended precision.
inline long double orientation(const Vector2& a, const Vector2& b, const Vector2& c) {
    using Wide = long double;
    return (Wide(b.x) - Wide(a.x)) * (Wide(c.y) - Wide(a.y)) -
           (Wide(b.y) - Wide(a.y)) * (Wide(c.x) - Wide(a.x));
}

}  // namespace nearfield::oracle
