#include <engine/geometry/oriented_box.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nearfield::geometry {
namespace {

Vector turned_left(const Vector& v) {
    return {-v.y(), v.x()};
}

/// The direction of the largest spread of the vertices: the dominant eigenvector of their
/// covariance.
Vector principal_axis(const std::array<std::span<const Vector>, 2>& runs) {
    // Relative to one of the vertices, so that nothing cancels far from the polygon's centre.
    const Vector origin = runs[0].front();
    Vector sum = Vector::Zero();
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    double count = 0.0;
    for (const auto& run : runs) {
        for (const Vector& vertex : run) {
            const Vector v = vertex - origin;
            sum += v;
            xx += v.x() * v.x();
            xy += v.x() * v.y();
            yy += v.y() * v.y();
        }
        count += static_cast<double>(run.size());
    }
    xx -= sum.x() * sum.x() / count;
    xy -= sum.x() * sum.y() / count;
    yy -= sum.y() * sum.y() / count;
    // Its angle is half of that of (xx - yy, 2 xy).
    const double length = std::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy);
    if (!(length > 0.0)) {
        return Vector::UnitX();
    }
    const double cosine = std::clamp((xx - yy) / length, -1.0, 1.0);
    return {std::sqrt(0.5 * (1.0 + cosine)), std::copysign(std::sqrt(0.5 * (1.0 - cosine)), xy)};
}

/// The extent of a box from its centre along a unit direction.
double reach(const OrientedBox& box, const Vector& direction) {
    return box.half.x() * std::abs(box.axis.dot(direction)) +
           box.half.y() * std::abs(cross(box.axis, direction));
}

}  // namespace

OrientedBox oriented_box(const TransformedPolygon& placed, std::span<const Vector> run,
                         std::span<const Vector> wrapped, double rounding) {
    const std::array<std::span<const Vector>, 2> runs{run, wrapped};
    const Vector axis = principal_axis(runs);
    Box box;
    for (const auto& vertices : runs) {
        for (const Vector& v : vertices) {
            box.extend(Vector(axis.dot(v), cross(axis, v)));
        }
    }
    const Vector middle = box.center();
    return {placed.to_world(middle.x() * axis + middle.y() * turned_left(axis)),
            placed.rotation() * axis, 0.5 * box.sizes() + Vector::Constant(rounding)};
}

double gap(const OrientedBox& a, const OrientedBox& b) {
    const Vector between = b.centre - a.centre;
    double widest = -std::numeric_limits<double>::infinity();
    for (const Vector& direction : {a.axis, turned_left(a.axis), b.axis, turned_left(b.axis)}) {
        widest = std::max(
            widest, std::abs(between.dot(direction)) - reach(a, direction) - reach(b, direction));
    }
    return widest;
}

}  // namespace nearfield::geometry
