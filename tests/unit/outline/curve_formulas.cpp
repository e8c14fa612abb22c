#include <tests/unit/support/curve_formulas.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nearfield::test {

using geometry::Vector;

Formula cubic(Vector p, Vector q, Vector r, Vector s) {
    return [=](double t) -> Vector {
        const double u = 1.0 - t;
        return u * u * u * p + 3.0 * u * u * t * q + 3.0 * u * t * t * r + t * t * t * s;
    };
}

Formula quadratic(Vector p, Vector q, Vector r) {
    return [=](double t) -> Vector {
        const double u = 1.0 - t;
        return u * u * p + 2.0 * u * t * q + t * t * r;
    };
}

Formula ellipse(Vector centre, double radius_x, double radius_y, double rotation, double start,
                double sweep) {
    return [=](double t) -> Vector {
        const double angle = start + t * sweep;
        const Vector own(radius_x * std::cos(angle), radius_y * std::sin(angle));
        return centre + Eigen::Rotation2Dd(rotation) * own;
    };
}

Formula svg_arc(Vector from, Vector to, EllipticArc arc) {
    using Real = long double;
    const Real cosine = std::cos(static_cast<Real>(arc.rotation));
    const Real sine = std::sin(static_cast<Real>(arc.rotation));
    const Real dx = (static_cast<Real>(from.x()) - to.x()) / 2;
    const Real dy = (static_cast<Real>(from.y()) - to.y()) / 2;
    const Real x = cosine * dx + sine * dy;
    const Real y = -sine * dx + cosine * dy;
    Real rx = std::abs(static_cast<Real>(arc.radius_x));
    Real ry = std::abs(static_cast<Real>(arc.radius_y));
    const Real needed = x * x / (rx * rx) + y * y / (ry * ry);
    if (needed > 1) {
        rx *= std::sqrt(needed);
        ry *= std::sqrt(needed);
    }
    const Real numerator = std::max<Real>(0, rx * rx * ry * ry - rx * rx * y * y - ry * ry * x * x);
    Real factor = std::sqrt(numerator / (rx * rx * y * y + ry * ry * x * x));
    factor = arc.large == arc.counter_clockwise ? -factor : factor;
    const Real cx = factor * rx * y / ry;
    const Real cy = -factor * ry * x / rx;
    const Real start = std::atan2((y - cy) / ry, (x - cx) / rx);
    Real sweep = std::atan2((-y - cy) / ry, (-x - cx) / rx) - start;
    const Real turn = 2 * std::numbers::pi_v<Real>;
    if (arc.counter_clockwise && sweep < 0) {
        sweep += turn;
    } else if (!arc.counter_clockwise && sweep > 0) {
        sweep -= turn;
    }
    const Vector centre(
        static_cast<double>(cosine * cx - sine * cy + (static_cast<Real>(from.x()) + to.x()) / 2),
        static_cast<double>(sine * cx + cosine * cy + (static_cast<Real>(from.y()) + to.y()) / 2));
    return ellipse(centre, static_cast<double>(rx), static_cast<double>(ry), arc.rotation,
                   static_cast<double>(start), static_cast<double>(sweep));
}

}  // namespace nearfield::test
