#include <tests/oracle/fill_law.hpp>
#include <tests/oracle/plane.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::oracle {
namespace {

/// Points in double precision are off by less than this, in units.
constexpr double rounding = 256.0;

/// The part of the way from `from` along `way` at which a point is nearest.
double nearest_part(const Vector2& from, const Vector2& way, const Vector2& point) {
    return std::clamp(dot(minus(point, from), way) / dot(way, way), 0.0, 1.0);
}

/// Where two segments cross, as points.
void add_crossing(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d,
                  std::vector<Vector2>& crossings) {
    const long double of_c = orientation(a, b, c);
    const long double of_d = orientation(a, b, d);
    if ((of_c > 0) != (of_d > 0) && (orientation(c, d, a) > 0) != (orientation(c, d, b) > 0)) {
        crossings.push_back(plus(c, times(minus(d, c), static_cast<double>(of_c / (of_c - of_d)))));
    }
}

}  // namespace

FillLaw::FillLaw(std::span<const Ring> rings, double unit, FillRule rule,
                 const ResolvedFill& resolved)
    : unit_(unit),
      radius_(resolved.deviation / unit + rounding),
      asked_(rings, unit, rule),
      resolved_(resolved.rings) {
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2 way = minus(ring[(i + 1) % ring.size()], ring[i]);
            if (length(way) > 0.0) {
                lines_.push_back({ring[i], way, length(way)});
            }
        }
    }
}

test::WholePlace FillLaw::placed(const Vector2& point) const {
    return {std::llround(point.x / unit_), std::llround(point.y / unit_)};
}

bool FillLaw::is_clear(const Vector2& point, int side) const {
    const test::WholePlace place = placed(point);
    return asked_.side(place) == side && asked_.distance(place) > radius_;
}

bool FillLaw::allows(const Measured& from, double answered, double bound, int side) const {
    return is_near(from, answered + bound, side) &&
           !(answered > bound && is_clearly_near(from, answered - bound, side));
}

bool FillLaw::allows(const Vector2& from, double answered, double bound) const {
    const Measured point{{from}, [from](const Vector2& to) { return oracle::distance(from, to); }};
    return allows(point, std::abs(answered), bound, answered < 0.0 ? 0 : 1);
}

bool FillLaw::is_on_boundary(const Vector2& point) const {
    const test::WholePlace place = placed(point);
    return asked_.has_near(place, radius_, 0) && asked_.has_near(place, radius_, 1);
}

bool FillLaw::is_near(const Measured& from, double distance, int side) const {
    std::vector<Vector2> candidates = from.corners;
    for (const Vector2& corner : from.corners) {
        candidates.push_back(resolved_.nearest(corner).point);
    }
    for (std::uint32_t i = 0; i < resolved_.size(); ++i) {
        const Vector2 a = resolved_.vertex(i);
        const Vector2 b = resolved_.vertex(resolved_.next(i));
        candidates.push_back(a);
        for (std::size_t k = 0; from.corners.size() > 1 && k < from.corners.size(); ++k) {
            const Vector2& c = from.corners[k];
            const Vector2& d = from.corners[(k + 1) % from.corners.size()];
            add_crossing(a, b, c, d, candidates);
        }
    }
    return std::any_of(candidates.begin(), candidates.end(), [&](const Vector2& candidate) {
        return from.distance(candidate) <= distance &&
               asked_.has_near(placed(candidate), radius_, side);
    });
}

std::vector<double> FillLaw::parts_to_look_at(const Line& line, const Measured& from) const {
    std::vector<double> centres{0.0, 1.0};
    for (const Vector2& corner : from.corners) {
        centres.push_back(nearest_part(line.from, line.way, corner));
    }
    std::vector<Vector2> crossings;
    const Vector2 to = plus(line.from, line.way);
    for (const Line& other : lines_) {
        add_crossing(line.from, to, other.from, plus(other.from, other.way), crossings);
    }
    for (const Vector2& crossing : crossings) {
        centres.push_back(nearest_part(line.from, line.way, crossing));
    }
    std::vector<double> parts = centres;
    for (const double centre : centres) {
        for (int k = 0; k < 90; ++k) {
            const double step = std::exp2(-0.5 * k);
            parts.insert(parts.end(), {centre - step, centre + step});
        }
    }
    std::erase_if(parts, [](double part) { return part < 0.0 || part > 1.0; });
    return parts;
}

bool FillLaw::is_clearly_near(const Measured& from, double distance, int side) const {
    const auto is_witness = [&](const Vector2& point) {
        return from.distance(point) < distance && is_clear(point, side);
    };
    if (std::any_of(from.corners.begin(), from.corners.end(), is_witness)) {
        return true;
    }
    const double beside = (radius_ + 2.0 * rounding) * unit_;
    for (const Line& line : lines_) {
        const Vector2 normal =
            times(Vector2{-line.way.y / line.length, line.way.x / line.length}, beside);
        for (const double part : parts_to_look_at(line, from)) {
            const Vector2 at = plus(line.from, times(line.way, part));
            if (is_witness(plus(at, normal)) || is_witness(minus(at, normal))) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace nearfield::oracle
