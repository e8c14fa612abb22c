#include "placed_rings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

Wide cross(const WidePoint& a, const WidePoint& b) {
    return a.x * b.y - a.y * b.x;
}

WidePoint minus(const WidePoint& a, const WidePoint& b) {
    return {a.x - b.x, a.y - b.y};
}

Wide length(const WidePoint& a) {
    return std::hypot(a.x, a.y);
}

}  // namespace

Wide distance_between(const WidePoint& a, const WidePoint& b) {
    return length(minus(a, b));
}

Wide distance_from(const WideEdge& edge, const WidePoint& p) {
    const WidePoint along = minus(edge.to, edge.from);
    const WidePoint of_p = minus(p, edge.from);
    const Wide squared = along.x * along.x + along.y * along.y;
    const Wide part = squared > 0.0L ? (along.x * of_p.x + along.y * of_p.y) / squared : 0.0L;
    const Wide t = std::clamp(part, 0.0L, 1.0L);
    return length({of_p.x - t * along.x, of_p.y - t * along.y});
}

Crossing crossing_of(const WideEdge& a, const WideEdge& b) {
    const WidePoint along_a = minus(a.to, a.from);
    const WidePoint along_b = minus(b.to, b.from);
    const Wide from_side = cross(along_b, minus(a.from, b.from));
    const Wide to_side = cross(along_b, minus(a.to, b.from));
    const Wide b_from = cross(along_a, minus(b.from, a.from));
    const Wide b_to = cross(along_a, minus(b.to, a.from));
    Crossing crossing;
    crossing.is_proper = from_side * to_side < 0.0L && b_from * b_to < 0.0L;
    if (crossing.is_proper) {
        crossing.parameter = from_side / (from_side - to_side);
        crossing.sine = std::abs(cross(along_a, along_b)) / (length(along_a) * length(along_b));
        crossing.margin = std::min({distance_from(b, a.from), distance_from(b, a.to),
                                    distance_from(a, b.from), distance_from(a, b.to)});
    }
    return crossing;
}

Wide distance_between(const WideEdge& a, const WideEdge& b) {
    if (crossing_of(a, b).is_proper) {
        return 0.0L;
    }
    return std::min({distance_from(b, a.from), distance_from(b, a.to), distance_from(a, b.from),
                     distance_from(a, b.to)});
}

PlacedRings::PlacedRings(std::span<const Ring> rings, const Pose& pose) {
    const Wide c = std::cos(static_cast<Wide>(pose.angle));
    const Wide s = std::sin(static_cast<Wide>(pose.angle));
    for (const Ring& ring : rings) {
        std::size_t count = ring.size();
        if (count > 1 && ring.front() == ring.back()) {
            --count;
        }
        const std::size_t first = vertices_.size();
        for (std::size_t i = 0; i < count; ++i) {
            const WidePoint v = wide(ring[i]);
            vertices_.push_back(
                {c * v.x - s * v.y + pose.translation.x, s * v.x + c * v.y + pose.translation.y});
            const auto largest =
                std::max({std::abs(v.x), std::abs(v.y), std::abs(vertices_.back().x),
                          std::abs(vertices_.back().y)});
            magnitude_ = std::max(magnitude_, static_cast<double>(largest));
        }
        for (std::size_t i = 0; i < count; ++i) {
            edges_.push_back({vertices_[first + i], vertices_[first + (i + 1) % count]});
        }
    }
}

bool PlacedRings::contains(const WidePoint& p) const {
    bool inside = false;
    for (const WideEdge& edge : edges_) {
        if ((edge.from.y > p.y) == (edge.to.y > p.y)) {
            continue;
        }
        const bool upward = edge.to.y > edge.from.y;
        const Wide side = cross(minus(edge.to, edge.from), minus(p, edge.from));
        inside ^= upward ? side > 0.0L : side < 0.0L;
    }
    return inside;
}

Wide PlacedRings::distance_from_boundary(const WidePoint& p) const {
    Wide least = std::numeric_limits<Wide>::infinity();
    for (const WideEdge& edge : edges_) {
        least = std::min(least, distance_from(edge, p));
    }
    return least;
}

Wide PlacedRings::signed_distance(const WidePoint& p) const {
    const Wide distance = distance_from_boundary(p);
    return contains(p) ? -distance : distance;
}

bool PlacedRings::meets(const Rectangle& rectangle) const {
    const WidePoint low = wide(rectangle.min);
    const WidePoint high = wide(rectangle.max);
    const auto holds = [&](const WidePoint& p) {
        return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
    };
    const WidePoint corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    for (const WideEdge& edge : edges_) {
        if (holds(edge.from)) {
            return true;
        }
        if (std::max(edge.from.x, edge.to.x) < low.x || std::min(edge.from.x, edge.to.x) > high.x ||
            std::max(edge.from.y, edge.to.y) < low.y || std::min(edge.from.y, edge.to.y) > high.y) {
            continue;
        }
        for (std::size_t i = 0; i < 4; ++i) {
            if (distance_between(edge, {corners[i], corners[(i + 1) % 4]}) == 0.0L) {
                return true;
            }
        }
    }
    return contains(low);
}

Wide PlacedRings::deepest_vertex(const PlacedRings& inner) const {
    Wide deepest = 0.0L;
    for (const WidePoint& vertex : inner.vertices()) {
        if (contains(vertex)) {
            deepest = std::max(deepest, distance_from_boundary(vertex));
        }
    }
    return deepest;
}

}  // namespace nearfield::test
