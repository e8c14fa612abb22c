#include <engine/geometry/vector.hpp>
#include <nearfield/curve.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace nearfield {
namespace {

using geometry::arc_sine;
using geometry::direction;
using geometry::to_public;
using geometry::to_vector;
using geometry::Vector;
using std::numbers::pi;

/// Rotates a vector a quarter turn counter-clockwise.
Vector turned_left(const Vector& v) {
    return {-v.y(), v.x()};
}

CurveSegment line(const Vector2& to) {
    CurveSegment segment;
    segment.to = to;
    return segment;
}

CurveSegment cubic(const Vector2& control_1, const Vector2& control_2, const Vector2& to) {
    CurveSegment segment;
    segment.kind = CurveSegment::Kind::cubic;
    segment.control_1 = control_1;
    segment.control_2 = control_2;
    segment.to = to;
    return segment;
}

CurveSegment arc_segment(const Vector& apex, const Vector& along, double half_sweep,
                         const Vector2& to) {
    CurveSegment segment;
    segment.kind = CurveSegment::Kind::arc;
    segment.apex = to_public(apex);
    segment.along = to_public(along);
    segment.half_sweep = half_sweep;
    segment.to = to;
    return segment;
}

/// A full ellipse that begins and ends at the tip of `axis`, the first of two conjugate
/// semi-diameters.
CurveContour whole_turn(const Vector& centre, const Vector& axis, const Vector& other) {
    const Vector2 start = to_public(centre + axis);
    return {start, {arc_segment(-axis, -other, pi, start)}};
}

}  // namespace

Vector2 CurvePath::current() const {
    const CurveContour& contour = contours_.back();
    return open_ && !contour.segments.empty() ? contour.segments.back().to : contour.start;
}

void CurvePath::refuse(const char* what, const char* why) {
    if (problem_.empty()) {
        problem_ = "contour " + std::to_string(contours_.empty() ? 0 : contours_.size() - 1) +
                   ", " + what + ": " + why;
    }
}

void CurvePath::add(const char* what, const CurveSegment& segment) {
    if (contours_.empty()) {
        refuse(what, "no point to begin at; a contour begins with move_to");
        return;
    }
    if (!open_) {
        const Vector2 start = contours_.back().start;
        move_to(start);
    }
    contours_.back().segments.push_back(segment);
}

CurvePath& CurvePath::move_to(Vector2 start) {
    contours_.push_back({start, {}});
    open_ = true;
    return *this;
}

CurvePath& CurvePath::line_to(Vector2 to) {
    add("line_to", line(to));
    return *this;
}

CurvePath& CurvePath::quadratic_to(Vector2 control, Vector2 to) {
    // Degree elevation: the cubic that is the same curve.
    const Vector middle = to_vector(control);
    const Vector start = contours_.empty() ? middle : to_vector(current());
    add("quadratic_to",
        cubic(to_public(start + (2.0 / 3.0) * (middle - start)),
              to_public(to_vector(to) + (2.0 / 3.0) * (middle - to_vector(to))), to));
    return *this;
}

CurvePath& CurvePath::cubic_to(Vector2 control_1, Vector2 control_2, Vector2 to) {
    add("cubic_to", cubic(control_1, control_2, to));
    return *this;
}

CurvePath& CurvePath::arc_to(const EllipticArc& arc, Vector2 to) {
    if (!std::isfinite(arc.radius_x) || !std::isfinite(arc.radius_y) ||
        !std::isfinite(arc.rotation)) {
        refuse("arc_to", "a radius or the rotation is not a finite number");
        return *this;
    }
    double radius_x = std::abs(arc.radius_x);
    double radius_y = std::abs(arc.radius_y);
    if (contours_.empty() || radius_x == 0.0 || radius_y == 0.0) {
        add("arc_to", line(to));
        return *this;
    }
    const Vector half_chord = 0.5 * (to_vector(to) - to_vector(current()));
    if (half_chord == Vector::Zero()) {
        return *this;
    }
    const Vector axis_x = direction(arc.rotation);
    const Vector axis_y = turned_left(axis_x);
    // In coordinates where the ellipse is a unit circle, half the chord is the sine of half the
    // sweep.
    Vector unit(half_chord.dot(axis_x) / radius_x, half_chord.dot(axis_y) / radius_y);
    const double sine = unit.stableNorm();
    if (sine == 0.0) {  // too short for the ellipse to resolve in double precision
        add("arc_to", line(to));
        return *this;
    }
    unit /= sine;
    if (sine > 1.0) {
        radius_x *= sine;
        radius_y *= sine;
    }
    const double narrow = arc_sine(std::min(sine, 1.0));
    const auto from_unit = [&](const Vector& v) -> Vector {
        return v.x() * radius_x * axis_x + v.y() * radius_y * axis_y;
    };
    const Vector apex = arc.counter_clockwise ? -turned_left(unit) : turned_left(unit);
    add("arc_to",
        arc_segment(from_unit(apex), from_unit(unit), arc.large ? pi - narrow : narrow, to));
    return *this;
}

CurvePath& CurvePath::arc_about(Vector2 centre, double sweep) {
    if (!(std::abs(sweep) <= 2.0 * pi)) {
        refuse("arc_about", "the sweep is not a number of at most a whole turn");
        return *this;
    }
    if (contours_.empty() || sweep == 0.0) {
        if (contours_.empty()) {
            add("arc_about", {});
        }
        return *this;
    }
    const Vector radius = to_vector(current()) - to_vector(centre);
    const auto turned = [&](double angle) -> Vector {
        const Vector along = direction(angle);
        return along.x() * radius + along.y() * turned_left(radius);
    };
    const Vector apex = turned(0.5 * sweep);
    const Vector along = sweep > 0.0 ? turned_left(apex) : -turned_left(apex);
    const bool whole = std::abs(sweep) == 2.0 * pi;
    const Vector2 to = whole ? current() : to_public(to_vector(centre) + turned(sweep));
    add("arc_about", arc_segment(apex, along, 0.5 * std::abs(sweep), to));
    return *this;
}

CurvePath& CurvePath::close() {
    if (contours_.empty()) {
        refuse("close", "there is no contour to close");
    }
    open_ = false;
    return *this;
}

CurvePath& CurvePath::circle(Vector2 centre, double radius) {
    return ellipse(centre, radius, radius);
}

CurvePath& CurvePath::ellipse(Vector2 centre, double radius_x, double radius_y, double rotation) {
    if (!(std::isfinite(radius_x) && std::isfinite(radius_y) && std::isfinite(rotation))) {
        refuse("ellipse", "a radius or the rotation is not a finite number");
        return *this;
    }
    const Vector axis = direction(rotation);
    contours_.push_back(whole_turn(to_vector(centre), std::abs(radius_x) * axis,
                                   std::abs(radius_y) * turned_left(axis)));
    open_ = false;
    return *this;
}

CurvePath& CurvePath::catmull_rom(std::span<const Vector2> points) {
    std::vector<Vector> through;
    for (const Vector2& point : points) {
        if (through.empty() || through.back() != to_vector(point)) {
            through.push_back(to_vector(point));
        }
    }
    while (through.size() > 1 && through.front() == through.back()) {
        through.pop_back();
    }
    const std::size_t count = through.size();
    if (count < 3) {
        refuse("catmull_rom", "a closed spline needs three points");
        return *this;
    }
    // The tangent at a point from the chords before and after it, with the square roots of their
    // lengths as the steps of the centripetal parameter.
    const auto way = [&](std::size_t i) -> Vector {
        return through[(i + 1) % count] - through[i % count];
    };
    const auto step = [&](std::size_t i) { return std::sqrt(way(i).stableNorm()); };
    const auto tangent = [&](std::size_t i) -> Vector {
        const double before = step(i + count - 1);
        const double after = step(i);
        return (before / after * way(i) + after / before * way(i + count - 1)) / (before + after);
    };
    contours_.push_back({to_public(through.front()), {}});
    for (std::size_t i = 0; i < count; ++i) {
        const Vector& from = through[i];
        const Vector& to = through[(i + 1) % count];
        contours_.back().segments.push_back(cubic(to_public(from + step(i) / 3.0 * tangent(i)),
                                                  to_public(to - step(i) / 3.0 * tangent(i + 1)),
                                                  to_public(to)));
    }
    open_ = false;
    return *this;
}

CurvePath& CurvePath::append(const CurvePath& other) {
    if (problem_.empty()) {
        problem_ = other.problem_;
    }
    contours_.insert(contours_.end(), other.contours_.begin(), other.contours_.end());
    open_ = false;
    return *this;
}

CurvePath& CurvePath::transform(const AffineMap& map) {
    const auto vector = [&](Vector2& v) {
        v = {v.x * map.x_axis.x + v.y * map.y_axis.x, v.x * map.x_axis.y + v.y * map.y_axis.y};
    };
    const auto point = [&](Vector2& p) {
        vector(p);
        p = {p.x + map.origin.x, p.y + map.origin.y};
    };
    for (CurveContour& contour : contours_) {
        point(contour.start);
        for (CurveSegment& segment : contour.segments) {
            point(segment.to);
            if (segment.kind == CurveSegment::Kind::cubic) {
                point(segment.control_1);
                point(segment.control_2);
            } else if (segment.kind == CurveSegment::Kind::arc) {
                vector(segment.apex);
                vector(segment.along);
            }
        }
    }
    return *this;
}

}  // namespace nearfield
