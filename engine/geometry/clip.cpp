#include <engine/geometry/clip.hpp>

#include <algorithm>

namespace nearfield::geometry {

Vector point_on_line(const Vector& a, const Vector& b, int axis, double value) {
    Vector point = a + (value - a[axis]) / (b[axis] - a[axis]) * (b - a);
    point[axis] = value;
    return point;
}

bool clip_to_slab(Vector& a, Vector& b, int axis, double low, double high) {
    if (std::max(a[axis], b[axis]) < low || std::min(a[axis], b[axis]) > high) {
        return false;
    }
    const Vector from = a;
    const Vector to = b;
    for (Vector* end : {&a, &b}) {
        const double inside = std::clamp((*end)[axis], low, high);
        if (inside != (*end)[axis]) {
            *end = point_on_line(from, to, axis, inside);
        }
    }
    return true;
}

}  // namespace nearfield::geometry
