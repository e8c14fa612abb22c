#include <engine/geometry/segment.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::geometry {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The side of the line through a and b that the point p is on: 1 left, -1 right, 0 on it.
int side(const Vector& a, const Vector& b, const Vector& p) {
    const double determinant = cross(b - a, p - a);
    return (determinant > 0.0 ? 1 : 0) - (determinant < 0.0 ? 1 : 0);
}

Box box_of(const Vector& a, const Vector& b) {
    return {a.cwiseMin(b), a.cwiseMax(b)};
}

/// True if segment cd lies on one side of the line through a and b, farther away than `margin`.
bool beside(const Vector& a, const Vector& b, const Vector& c, const Vector& d, double margin) {
    const Vector along = b - a;
    // The sum of the coordinates bounds the length from above and needs no square root.
    const double reach = margin * along.lpNorm<1>();
    const double side_c = cross(along, c - a);
    const double side_d = cross(along, d - a);
    // Without branches: which side it is cannot be predicted.
    return std::min(side_c, side_d) > reach || std::max(side_c, side_d) < -reach;
}

/// False if a point is certainly more than `margin`, which covers rounding, from the line through
/// two others.
bool may_be_near(const Vector& p, const Vector& from, const Vector& to, double margin) {
    const Vector along = to - from;
    return std::abs(cross(along, p - from)) <= 4.0 * margin * along.lpNorm<1>();
}

/// The parameter on ab of its crossing with cd, if each end is certainly more than `margin` from
/// the other segment's line, and the crossing certainly beside cd. Otherwise, `never`.
double clear_crossing(const Vector& a, const Vector& b, const Vector& c, const Vector& d,
                      double margin) {
    const Vector along = b - a;
    const Vector across = d - c;
    const double a_side = cross(across, a - c);
    const double b_side = cross(across, b - c);
    const double c_side = cross(along, c - a);
    const double d_side = cross(along, d - a);
    // The sum of the coordinates bounds the length from above and needs no square root.
    const double reach = 4.0 * margin;
    const bool is_clear =
        a_side * b_side < 0.0 && c_side * d_side < 0.0 &&
        std::min(std::abs(a_side), std::abs(b_side)) > reach * across.lpNorm<1>() &&
        std::min(std::abs(c_side), std::abs(d_side)) > reach * along.lpNorm<1>();
    if (!is_clear) {
        return never;
    }
    const double parameter = a_side / (a_side - b_side);
    const double at = parameter * along.squaredNorm();
    const double at_c = along.dot(c - a);
    const double at_d = along.dot(d - a);
    return std::min(at_c, at_d) < at && at < std::max(at_c, at_d) ? parameter : never;
}

}  // namespace

bool segments_intersect(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    // The boxes decide for collinear segments and for points.
    if (!box_of(a, b).intersects(box_of(c, d))) {
        return false;
    }
    return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

bool segments_meet(const Vector& a, const Vector& b, const Vector& c, const Vector& d,
                   double margin) {
    if (beside(a, b, c, d, margin) || beside(c, d, a, b, margin)) {
        return false;
    }
    // Segments that do not cross are nearest at an end of one of them.
    const auto near = [&](const Vector& p, const Vector& from, const Vector& to) {
        return nearest_on_segment(p, from, to).squared_distance <= margin * margin;
    };
    return segments_intersect(a, b, c, d) || near(a, c, d) || near(b, c, d) || near(c, a, b) ||
           near(d, a, b);
}

double first_meeting(const Vector& a, const Vector& b, const Vector& c, const Vector& d,
                     double margin) {
    // Almost all meetings are of this kind.
    const double crossing = clear_crossing(a, b, c, d, margin);
    if (crossing != never) {
        return crossing;
    }
    const double reach = margin * margin;
    if (may_be_near(a, c, d, margin) && nearest_on_segment(a, c, d).squared_distance <= reach) {
        return 0.0;
    }
    // Either an end of cd touches ab, or the other end of ab touches cd, or they cross.
    double first = never;
    const NearestOnSegment at_c = nearest_on_segment(c, a, b);
    const NearestOnSegment at_d = nearest_on_segment(d, a, b);
    for (const NearestOnSegment& end : {at_c, at_d}) {
        if (end.squared_distance <= reach) {
            first = std::min(first, end.parameter);
        }
    }
    if (may_be_near(b, c, d, margin) && nearest_on_segment(b, c, d).squared_distance <= reach) {
        first = std::min(first, 1.0);
    }
    if (segments_intersect(a, b, c, d)) {
        const double a_side = std::abs(cross(d - c, a - c));
        const double b_side = std::abs(cross(d - c, b - c));
        if (a_side + b_side > 0.0) {
            // Of segments that are almost parallel the sides are little more than rounding, but the
            // crossing is beside cd all the same.
            const auto [low, high] = std::minmax(at_c.parameter, at_d.parameter);
            first = std::min(first, std::clamp(a_side / (a_side + b_side), low, high));
        }
    }
    return first;
}

ClosestOfSegments closest_of_segments(const Vector& a, const Vector& b, const Vector& c,
                                      const Vector& d) {
    ClosestOfSegments closest;
    closest.squared_distance = std::numeric_limits<double>::infinity();
    // Segments that do not cross are closest at an end of one of them.
    const auto end_of_first = [&](const Vector& end, double parameter) {
        const NearestOnSegment nearest = nearest_on_segment(end, c, d);
        if (nearest.squared_distance < closest.squared_distance) {
            closest = {end, nearest.point, parameter, nearest.parameter, nearest.squared_distance};
        }
    };
    const auto end_of_second = [&](const Vector& end, double parameter) {
        const NearestOnSegment nearest = nearest_on_segment(end, a, b);
        if (nearest.squared_distance < closest.squared_distance) {
            closest = {nearest.point, end, nearest.parameter, parameter, nearest.squared_distance};
        }
    };
    end_of_first(a, 0.0);
    end_of_first(b, 1.0);
    end_of_second(c, 0.0);
    end_of_second(d, 1.0);
    if (closest.squared_distance > 0.0 && segments_intersect(a, b, c, d)) {
        // The sides of a and b locate the crossing on ab.
        const double a_side = std::abs(cross(d - c, a - c));
        const double b_side = std::abs(cross(d - c, b - c));
        if (a_side + b_side > 0.0) {
            const double parameter = a_side / (a_side + b_side);
            const Vector crossing = a + parameter * (b - a);
            const NearestOnSegment on_second = nearest_on_segment(crossing, c, d);
            // Of segments along one line the sides are rounding alone, and locate nothing; then an
            // end is on the other segment. Of segments that are almost parallel they say little
            // about where along them the crossing is, and yet it is on both.
            if (on_second.squared_distance < closest.squared_distance) {
                closest.first = crossing;
                closest.first_parameter = parameter;
                closest.second_parameter = on_second.parameter;
            }
            closest.second = closest.first;
            closest.squared_distance = 0.0;
        }
    }
    return closest;
}

}  // namespace nearfield::geometry
