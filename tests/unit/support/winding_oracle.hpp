#pragma once

#include <nearfield/fill.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

// Winding numbers in whole numbers: coordinates are multiples of a unit, and everything is exact.
namespace nearfield::test {

__extension__ using Wide = __int128;

/// A point in units.
struct WholePlace {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

/// More than 0 to the left of the line from a to b. Coordinates are below 2^62.
inline int side_of(const WholePlace& a, const WholePlace& b, const WholePlace& p) {
    const Wide left = static_cast<Wide>(b.x - a.x) * (p.y - a.y);
    const Wide right = static_cast<Wide>(b.y - a.y) * (p.x - a.x);
    return (left > right ? 1 : 0) - (left < right ? 1 : 0);
}

/// A place and a small offset, in units: a point between the places.
struct Spot {
    WholePlace place;
    long double dx = 0.0L;
    long double dy = 0.0L;

    /// A coordinate relative to this one. Exact for places no farther than 2^63.
    [[nodiscard]] long double x_of(const WholePlace& p) const {
        return static_cast<long double>(p.x - place.x) - dx;
    }
    [[nodiscard]] long double y_of(const WholePlace& p) const {
        return static_cast<long double>(p.y - place.y) - dy;
    }
};

/// The same for a spot. Exact without an offset; otherwise wrong at most for spots that are closer
/// to the line than 2^-40 of the offset.
inline int side_of(const WholePlace& a, const WholePlace& b, const Spot& spot) {
    const Wide left = static_cast<Wide>(b.x - a.x) * (spot.place.y - a.y);
    const Wide right = static_cast<Wide>(b.y - a.y) * (spot.place.x - a.x);
    const long double by = static_cast<long double>(b.x - a.x) * spot.dy -
                           static_cast<long double>(b.y - a.y) * spot.dx;
    const Wide at_place = left - right;
    if (at_place > -(Wide{1} << 62) && at_place < (Wide{1} << 62)) {
        const long double sum = static_cast<long double>(at_place) + by;
        return (sum > 0 ? 1 : 0) - (sum < 0 ? 1 : 0);
    }
    const Wide sum = at_place + static_cast<Wide>(by);
    return (sum > 0 ? 1 : 0) - (sum < 0 ? 1 : 0);
}

/// Rings in units, with their parts.
class WindingOracle {
public:
    /// Precondition: the coordinates are multiples of the unit.
    WindingOracle(std::span<const Ring> rings, double unit, FillRule rule,
                  std::span<const std::uint32_t> part_sizes = {})
        : rule_(rule) {
        std::size_t part = 0;
        std::size_t left = part_sizes.empty() ? 1 : part_sizes[0];
        for (const Ring& ring : rings) {
            while (left == 0) {
                left = part_sizes.empty() ? 1 : part_sizes[part + 1];
                ++part;
            }
            --left;
            parts_.push_back(part);
            std::vector<WholePlace>& places = rings_.emplace_back();
            for (const Vector2& vertex : ring) {
                places.push_back({static_cast<std::int64_t>(vertex.x / unit),
                                  static_cast<std::int64_t>(vertex.y / unit)});
            }
        }
    }

    [[nodiscard]] const std::vector<std::vector<WholePlace>>& rings() const { return rings_; }

    /// 1 inside the region, 0 outside, -1 on an edge (of the region or inside it).
    [[nodiscard]] int side(const WholePlace& p) const { return side(Spot{p}); }
    /// The same between the places.
    [[nodiscard]] int side(const Spot& spot) const {
        int total = 0;
        bool in_part = false;
        bool in_any = false;
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            int winding = 0;
            if (!add_winding(rings_[r], spot, winding)) {
                return -1;
            }
            total += winding;
            in_part = (r > 0 && parts_[r] == parts_[r - 1] && in_part) != (winding % 2 != 0);
            if (r + 1 == rings_.size() || parts_[r + 1] != parts_[r]) {
                in_any = in_any || in_part;
            }
        }
        switch (rule_) {
            case FillRule::odd_even:
                return total % 2 != 0 ? 1 : 0;
            case FillRule::nonzero:
                return total != 0 ? 1 : 0;
            case FillRule::positive:
                return total > 0 ? 1 : 0;
            case FillRule::union_of_parts:
                return in_any ? 1 : 0;
        }
        return 0;
    }

    /// True if a point within a radius (in units) of p has the given side. A region that reaches
    /// into the disc reaches its rim between two edges, or has a vertex or a crossing in the disc;
    /// these places are looked at where a pattern of points and the sides of edges do not suffice.
    [[nodiscard]] bool has_near(const WholePlace& p, double radius, int wanted) const {
        if (side(p) == wanted) {
            return true;
        }
        for (const double part : {1.0, 0.6, 0.25}) {
            for (int i = 0; i < 24; ++i) {
                const double angle = 0.2 + 0.2618 * i;
                if (is(p, part * radius * std::cos(angle), part * radius * std::sin(angle), radius,
                       wanted)) {
                    return true;
                }
            }
        }
        const bool found = std::any_of(rings_.begin(), rings_.end(), [&](const auto& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                if (edge_has(ring[i], ring[(i + 1) % ring.size()], p, radius, wanted)) {
                    return true;
                }
            }
            return false;
        });
        return found || rim_has(p, radius, wanted) || rim_has(p, 0.5 * radius, wanted) ||
               corner_has(p, radius, wanted);
    }

    /// The distance from p to the nearest edge, in units, up to rounding.
    [[nodiscard]] double distance(const WholePlace& p) const {
        double least = INFINITY;
        for (const std::vector<WholePlace>& ring : rings_) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const WholePlace& a = ring[i];
                const WholePlace& b = ring[(i + 1) % ring.size()];
                const auto dx = static_cast<long double>(b.x - a.x);
                const auto dy = static_cast<long double>(b.y - a.y);
                const auto px = static_cast<long double>(p.x - a.x);
                const auto py = static_cast<long double>(p.y - a.y);
                const long double squared = dx * dx + dy * dy;
                const long double along =
                    squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0L, 1.0L) : 0.0L;
                const long double gap = std::hypot(px - along * dx, py - along * dy);
                least = std::min(least, static_cast<double>(gap));
            }
        }
        return least;
    }

private:
    /// Adds the winding number of one ring; false if the spot is on it.
    static bool add_winding(const std::vector<WholePlace>& ring, const Spot& spot, int& winding) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const WholePlace& a = ring[i];
            const WholePlace& b = ring[i + 1 == ring.size() ? 0 : i + 1];
            const long double from = spot.y_of(a);
            const long double to = spot.y_of(b);
            if (std::max(from, to) < 0 || std::min(from, to) > 0 ||
                std::max(spot.x_of(a), spot.x_of(b)) < 0) {
                continue;
            }
            const int side = side_of(a, b, spot);
            if (side == 0 && std::min(spot.x_of(a), spot.x_of(b)) <= 0) {
                return false;
            }
            if (from <= 0 && to > 0 && side > 0) {
                ++winding;
            } else if (to <= 0 && from > 0 && side < 0) {
                --winding;
            }
        }
        return true;
    }

    [[nodiscard]] bool is(const WholePlace& p, long double dx, long double dy, double radius,
                          int wanted) const {
        return std::hypot(dx, dy) <= radius && side(Spot{p, dx, dy}) == wanted;
    }

    /// Looks beside the part of an edge that is within the radius.
    [[nodiscard]] bool edge_has(const WholePlace& a, const WholePlace& b, const WholePlace& p,
                                double radius, int wanted) const {
        const auto dx = static_cast<long double>(b.x - a.x);
        const auto dy = static_cast<long double>(b.y - a.y);
        const auto px = static_cast<long double>(p.x - a.x);
        const auto py = static_cast<long double>(p.y - a.y);
        const long double length = std::hypot(dx, dy);
        if (length == 0) {
            return false;
        }
        const long double along = (px * dx + py * dy) / length;
        const long double across = (px * dy - py * dx) / length;
        if (std::abs(across) > radius) {
            return false;
        }
        const long double half = std::sqrt(radius * radius - across * across);
        for (int i = -8; i <= 8; ++i) {
            const long double at = std::clamp(along + half * i / 8.2L, 0.0L, length);
            for (const long double beside : {-1.5L, 1.5L, -3.0L, 3.0L}) {
                const long double x = (at * dx - beside * dy) / length - px;
                const long double y = (at * dy + beside * dx) / length - py;
                if (is(p, x, y, radius, wanted)) {
                    return true;
                }
            }
        }
        return false;
    }

    /// An edge relative to a point, in units.
    struct Chord {
        long double x, y;    // where it begins
        long double dx, dy;  // to its end
        long double cross;   // x dy - y dx, rounded once
    };

    [[nodiscard]] std::vector<Chord> chords(const WholePlace& p) const {
        std::vector<Chord> result;
        for (const std::vector<WholePlace>& ring : rings_) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const WholePlace& a = ring[i];
                const WholePlace& b = ring[(i + 1) % ring.size()];
                const Wide cross = static_cast<Wide>(a.x - p.x) * (b.y - a.y) -
                                   static_cast<Wide>(a.y - p.y) * (b.x - a.x);
                result.push_back(
                    {static_cast<long double>(a.x - p.x), static_cast<long double>(a.y - p.y),
                     static_cast<long double>(b.x - a.x), static_cast<long double>(b.y - a.y),
                     static_cast<long double>(cross)});
            }
        }
        return result;
    }

    /// Looks between the edges that pass the rim of the disc.
    [[nodiscard]] bool rim_has(const WholePlace& p, double radius, int wanted) const {
        const long double inner = radius - 1.0L;
        std::vector<long double> angles;
        for (const Chord& chord : chords(p)) {
            const long double length = std::hypot(chord.dx, chord.dy);
            if (length == 0 || std::abs(chord.cross) > inner * length) {
                continue;
            }
            // From the foot of the perpendicular along the edge, either way.
            const long double beside = chord.cross / length;
            const long double half = std::sqrt(inner * inner - beside * beside);
            for (const long double way : {-half, half}) {
                angles.push_back(std::atan2(way * chord.dy - beside * chord.dx,
                                            way * chord.dx + beside * chord.dy));
            }
        }
        if (angles.empty()) {
            return false;
        }
        std::sort(angles.begin(), angles.end());
        angles.push_back(angles.front() + 6.28318530717958647692L);
        for (std::size_t i = 1; i < angles.size(); ++i) {
            const long double middle = (angles[i - 1] + angles[i]) / 2;
            if (is(p, inner * std::cos(middle), inner * std::sin(middle), radius, wanted)) {
                return true;
            }
        }
        return false;
    }

    /// Looks around vertices and crossings in the disc.
    [[nodiscard]] bool corner_has(const WholePlace& p, double radius, int wanted) const {
        const std::vector<Chord> all = chords(p);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (around(p, all[i].x, all[i].y, radius, wanted)) {
                return true;
            }
            for (std::size_t j = 0; j < i; ++j) {
                const Chord& a = all[i];
                const Chord& b = all[j];
                const long double turn = a.dx * b.dy - a.dy * b.dx;
                const long double part = ((b.x - a.x) * b.dy - (b.y - a.y) * b.dx) / turn;
                if (turn != 0 && part >= 0 && part <= 1 &&
                    around(p, a.x + part * a.dx, a.y + part * a.dy, radius, wanted)) {
                    return true;
                }
            }
        }
        return false;
    }

    [[nodiscard]] bool around(const WholePlace& p, long double x, long double y, double radius,
                              int wanted) const {
        if (std::hypot(x, y) > radius) {
            return false;
        }
        for (const double by : {2.0, 6.0, 40.0, 300.0, 2000.0, 15000.0}) {
            for (int i = 0; i < 48; ++i) {
                const double angle = 0.01 + 0.1309 * i;
                if (is(p, x + by * std::cos(angle), y + by * std::sin(angle), radius, wanted)) {
                    return true;
                }
            }
        }
        return false;
    }

    FillRule rule_;
    std::vector<std::vector<WholePlace>> rings_;
    std::vector<std::size_t> parts_;
};

}  // namespace nearfield::test
