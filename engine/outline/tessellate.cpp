#include <engine/base/catch_to_status.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/geometry/number.hpp>
#include <engine/geometry/ring_check.hpp>
#include <engine/geometry/vector.hpp>
#include <nearfield/curve.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

// A piece of a curve is replaced by its chord where the piece is proven to be near it. Two bounds
// hold for every piece; the smaller one counts:
// - both run from end to end in the same parameter, and the second derivative bounds their distance
//   at every parameter. This holds for loops and cusps too.
// - a piece that stays in the strip perpendicular to the chord is no farther from the chord than
//   from the chord's line, and covers all of it.
namespace nearfield {
namespace {

using geometry::arc_sine;
using geometry::cross;
using geometry::largest_of;
using geometry::number;
using geometry::refuse_shape;
using geometry::to_public;
using geometry::to_vector;
using geometry::usable;
using geometry::Vector;
using std::numbers::pi;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Half of one minus the cosine of an angle, without cancellation.
double half_versine(double angle) {
    const double sine = sine_cosine(0.5 * angle).sine;
    return sine * sine;
}

/// A part of a cubic Bézier curve.
struct CubicPiece {
    std::array<Vector, 4> points;

    [[nodiscard]] const Vector& end() const { return points[3]; }

    /// An upper bound on the distance from the chord.
    [[nodiscard]] double deviation() const {
        const auto& [p, q, r, s] = points;
        // An eighth of the largest second derivative, which is linear: largest at an end.
        const double second = std::max((p - 2.0 * q + r).norm(), (q - 2.0 * r + s).norm());
        const double by_derivative = 0.75 * second;
        const Vector chord = s - p;
        const double squared = chord.squaredNorm();
        const double along_q = chord.dot(q - p);
        const double along_r = chord.dot(r - p);
        if (!(squared > 0.0 && 0.0 <= std::min(along_q, along_r) &&
              std::max(along_q, along_r) <= squared)) {
            return by_derivative;
        }
        // The inner points' distances have weights 3 t (1-t)^2 and 3 t^2 (1-t): together at most
        // 3/4, and at most 4/9 each.
        const double length = std::sqrt(squared);
        const double side_q = cross(chord, q - p) / length;
        const double side_r = cross(chord, r - p) / length;
        const double weight = side_q * side_r >= 0.0 ? 3.0 / 4.0 : 4.0 / 9.0;
        return std::min(by_derivative, weight * std::max(std::abs(side_q), std::abs(side_r)));
    }

    [[nodiscard]] std::array<CubicPiece, 2> halves() const {
        const auto& [p, q, r, s] = points;
        const Vector pq = 0.5 * (p + q);
        const Vector qr = 0.5 * (q + r);
        const Vector rs = 0.5 * (r + s);
        const Vector left = 0.5 * (pq + qr);
        const Vector right = 0.5 * (qr + rs);
        const Vector middle = 0.5 * (left + right);
        return {{{{p, pq, left, middle}}, {{middle, right, rs, s}}}};
    }
};

/// A part of an ellipse, in the form of CurveSegment.
struct ArcPiece {
    Vector start;
    Vector to;
    Vector apex;
    Vector along;
    double half_sweep = 0.0;

    [[nodiscard]] const Vector& end() const { return to; }

    /// The point at an angle from the middle.
    [[nodiscard]] Vector point(double angle) const {
        const double rise = 2.0 * sine_cosine(0.5 * (half_sweep + angle)).sine *
                            sine_cosine(0.5 * (half_sweep - angle)).sine;
        return 0.5 * (start + to) + rise * apex + sine_cosine(angle).sine * along;
    }

    [[nodiscard]] double deviation() const {
        // A whole turn has no chord; a third of a turn is the coarsest piece ever needed.
        if (half_sweep > 0.34 * pi) {
            return infinity;
        }
        // In coordinates where the ellipse is a unit circle, the arc deviates from its chord by up
        // to one minus the cosine of half the sweep, in the direction of the apex.
        const double rise = 2.0 * half_versine(half_sweep);
        const double by_parameter = rise * apex.norm();
        const double squared = along.squaredNorm();
        const auto [sine, cosine] = sine_cosine(half_sweep);
        const bool within_strip = sine / cosine * std::abs(apex.dot(along)) <= squared;
        if (!(squared > 0.0 && within_strip)) {
            return by_parameter;
        }
        return std::min(by_parameter, rise * std::abs(cross(apex, along)) / std::sqrt(squared));
    }

    [[nodiscard]] std::array<ArcPiece, 2> halves() const {
        const double quarter = 0.5 * half_sweep;
        const auto [sine, cosine] = sine_cosine(quarter);
        const Vector middle = point(0.0);
        return {
            {{start, middle, cosine * apex - sine * along, cosine * along + sine * apex, quarter},
             {middle, to, cosine * apex + sine * along, cosine * along - sine * apex, quarter}}};
    }

    /// The radius of a circle, up to rounding; 0 for any other ellipse.
    [[nodiscard]] double radius() const {
        constexpr double rounding = 1e-12;
        const double largest = std::max(apex.norm(), along.norm());
        const double smallest = std::min(apex.norm(), along.norm());
        const bool round = largest - smallest <= rounding * largest &&
                           std::abs(apex.dot(along)) <= rounding * largest * largest;
        return round ? (1.0 + 2.0 * rounding) * largest : 0.0;
    }
};

/// The largest coordinate of a segment's points and of their computation.
double magnitude(const CurveSegment& segment) {
    double result = largest_of(segment.to);
    if (segment.kind == CurveSegment::Kind::cubic) {
        result = std::max({result, largest_of(segment.control_1), largest_of(segment.control_2)});
    } else if (segment.kind == CurveSegment::Kind::arc) {
        result += 2.0 * half_versine(segment.half_sweep) * largest_of(segment.apex) +
                  std::min(segment.half_sweep, 1.0) * largest_of(segment.along);
    }
    return result;
}

bool usable(const CurveSegment& segment) {
    return usable(segment.to) && usable(segment.control_1) && usable(segment.control_2) &&
           usable(segment.apex) && usable(segment.along);
}

/// Checks all numbers of a path; returns the largest magnitude.
double checked_magnitude(const CurvePath& path) {
    double largest = 0.0;
    const std::span<const CurveContour> contours = path.contours();
    for (std::size_t c = 0; c < contours.size(); ++c) {
        const auto refuse_at = [&](const std::string& what) {
            refuse_shape("contour " + std::to_string(c) + ", " + what +
                         ": a number is not finite, or its magnitude exceeds " +
                         number(largest_coordinate));
        };
        if (!usable(contours[c].start)) {
            refuse_at("start");
        }
        largest = std::max(largest, largest_of(contours[c].start));
        for (std::size_t s = 0; s < contours[c].segments.size(); ++s) {
            if (!usable(contours[c].segments[s])) {
                refuse_at("segment " + std::to_string(s));
            }
            largest = std::max(largest, magnitude(contours[c].segments[s]));
        }
    }
    return largest;
}

class Tessellator {
public:
    /// `target`: the allowed deviation of a chord.
    Tessellator(double target, std::uint32_t most) : target_(target), room_(most), most_(most) {}

    Ring ring(const CurveContour& contour) {
        const std::size_t room = room_;
        Ring ring = divided(contour, 0);
        const bool curved =
            std::any_of(contour.segments.begin(), contour.segments.end(),
                        [](const auto& s) { return s.kind != CurveSegment::Kind::line; });
        if (ring.size() < 3 && curved) {
            room_ = room;
            ring = divided(contour, 2);
        }
        return ring;
    }

private:
    Ring divided(const CurveContour& contour, std::uint32_t min_depth) {
        ring_.clear();
        min_depth_ = min_depth;
        add(to_vector(contour.start));
        Vector from = to_vector(contour.start);
        for (const CurveSegment& segment : contour.segments) {
            const Vector to = to_vector(segment.to);
            if (segment.kind == CurveSegment::Kind::line) {
                add(to);
            } else if (segment.kind == CurveSegment::Kind::cubic) {
                divide(CubicPiece{{from, to_vector(segment.control_1), to_vector(segment.control_2),
                                   to}},
                       0);
            } else {
                add_arc({from, to, to_vector(segment.apex), to_vector(segment.along),
                         segment.half_sweep});
            }
            from = to;
        }
        if (ring_.size() > 1 && ring_.front() == ring_.back()) {
            ring_.pop_back();
            ++room_;
        }
        return std::move(ring_);
    }

    /// Terminates: each halving quarters the derivative's bound, and the target is far above
    /// rounding.
    template <class Piece>
    void divide(const Piece& piece, std::uint32_t depth) {
        if (depth >= min_depth_ && piece.deviation() <= target_) {
            add(piece.end());
            return;
        }
        for (const Piece& half : piece.halves()) {
            divide(half, depth + 1);
        }
    }

    void add_arc(const ArcPiece& arc) {
        const double radius = arc.radius();
        if (radius == 0.0) {
            divide(arc, 0);
            return;
        }
        // Parts of a circle are all alike, so equal parts are the fewest.
        const double share = std::min(1.0, target_ / (2.0 * radius));
        const double widest = std::min(4.0 * arc_sine(std::sqrt(share)), 2.0 * pi / 3.0);
        const double least = min_depth_ > 0 ? 4.0 : 1.0;
        const double parts = std::max(least, std::ceil(2.0 * arc.half_sweep / widest - 1e-9));
        if (parts > static_cast<double>(room_)) {
            refuse_size();
        }
        for (std::size_t part = 1; part < static_cast<std::size_t>(parts); ++part) {
            add(arc.point(arc.half_sweep * (2.0 * static_cast<double>(part) - parts) / parts));
        }
        add(arc.end());
    }

    void add(const Vector& vertex) {
        const Vector2 point = to_public(vertex);
        if (!ring_.empty() && ring_.back() == point) {
            return;
        }
        if (room_ == 0) {
            refuse_size();
        }
        --room_;
        ring_.push_back(point);
    }

    [[noreturn]] void refuse_size() const {
        throw StatusException({StatusCode::too_large,
                               "the tessellated shape needs more than " + std::to_string(most_) +
                                   " vertices, the limit; allow more deviation"});
    }

    double target_;
    std::size_t room_;
    std::uint32_t most_;
    std::uint32_t min_depth_ = 0;
    Ring ring_;
};

std::vector<Ring> rings_of(const CurvePath& path, double deviation, std::uint32_t most) {
    if (!path.problem().empty()) {
        refuse_shape(path.problem());
    }
    if (!(deviation > 0.0 && deviation <= largest_coordinate)) {
        refuse_shape("the deviation is " + number(deviation) +
                     "; it must be a finite number above 0 and at most " +
                     number(largest_coordinate));
    }
    // Halving a curve down to this rounds by far less than a sixty-fourth of it.
    const double epsilon = std::numeric_limits<double>::epsilon();
    const double smallest = 4096.0 * epsilon * checked_magnitude(path);
    if (deviation < smallest) {
        refuse_shape(
            "the deviation " + number(deviation) +
            " is below what double precision resolves at these coordinates; the smallest is " +
            number(smallest));
    }
    Tessellator tessellator(deviation - smallest / 64.0, most);
    std::vector<Ring> rings;
    for (const CurveContour& contour : path.contours()) {
        if (!contour.segments.empty()) {
            rings.push_back(tessellator.ring(contour));
        }
    }
    if (rings.empty()) {
        refuse_shape("the path has no contour");
    }
    return rings;
}

}  // namespace

Expected<std::vector<Ring>> tessellate(const CurvePath& path, double deviation,
                                       std::uint32_t most) {
    return catch_to_expected([&] { return rings_of(path, deviation, most); });
}

}  // namespace nearfield
