#include "shape_oracle.hpp"

#include <tests/oracle/plane.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::oracle {
namespace {

/// A point in extended precision.
struct WidePoint {
    long double x = 0.0L;
    long double y = 0.0L;
};

WidePoint placed(const Vector2& v, const Pose& pose) {
    const long double cosine = std::cos(static_cast<long double>(pose.angle));
    const long double sine = std::sin(static_cast<long double>(pose.angle));
    return {cosine * v.x - sine * v.y + pose.translation.x,
            sine * v.x + cosine * v.y + pose.translation.y};
}

std::size_t open_size(const Ring& ring) {
    return ring.size() > 1 && ring.front() == ring.back() ? ring.size() - 1 : ring.size();
}

Vector2 middle(std::span<const Ring> rings) {
    Vector2 low = rings.front().front();
    Vector2 high = low;
    for (const Ring& ring : rings) {
        for (const Vector2& v : ring) {
            low = {std::min(low.x, v.x), std::min(low.y, v.y)};
            high = {std::max(high.x, v.x), std::max(high.y, v.y)};
        }
    }
    return {low.x / 2 + high.x / 2, low.y / 2 + high.y / 2};
}

Vector2 rounded(const WidePoint& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

/// Vertices relative to `origin`, all rings in one list.
std::vector<Vector2> local_vertices_of(std::span<const Ring> rings, const Pose& pose,
                                       const Vector2& origin) {
    std::vector<Vector2> vertices;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < open_size(ring); ++i) {
            const WidePoint p = placed(ring[i], pose);
            vertices.push_back(rounded({p.x - origin.x, p.y - origin.y}));
        }
    }
    return vertices;
}

std::vector<Edge> edges_of(const std::vector<Vector2>& vertices, std::span<const Ring> rings) {
    std::vector<Edge> edges;
    std::size_t begin = 0;
    for (const Ring& ring : rings) {
        const std::size_t size = open_size(ring);
        for (std::size_t i = 0; i < size; ++i) {
            edges.push_back({vertices[begin + i], vertices[begin + (i + 1) % size]});
        }
        begin += size;
    }
    return edges;
}

}  // namespace

ShapeOracle::ShapeOracle(std::span<const Ring> rings, const Pose& pose)
    : origin_(rounded(placed(middle(rings), pose))),
      vertices_(local_vertices_of(rings, pose, origin_)),
      tree_(edges_of(vertices_, rings)) {
    double magnitude = std::abs(pose.translation.x) + std::abs(pose.translation.y);
    std::uint32_t begin = 0;
    for (const Ring& ring : rings) {
        const auto size = static_cast<std::uint32_t>(open_size(ring));
        ring_begins_.push_back(begin);
        for (std::uint32_t i = 0; i < size; ++i) {
            next_.push_back(begin + (i + 1) % size);
            previous_.push_back(begin + (i + size - 1) % size);
            magnitude = std::max(magnitude, std::abs(ring[i].x) + std::abs(ring[i].y));
        }
        begin += size;
    }
    // A few dozen rounding errors for coordinates of this magnitude.
    rounding_ = 32 * std::numeric_limits<double>::epsilon() * magnitude;
}

bool ShapeOracle::contains(const Vector2& point) const {
    const Vector2 p = minus(point, origin_);
    const Rectangle ray{p, {std::max(p.x, tree_.box().max.x), p.y}};
    bool inside = false;
    tree_.visit_box(ray, [&](std::uint32_t edge) {
        const auto& [from, to] = tree_.edges()[edge];
        if ((from.y > p.y) == (to.y > p.y)) {
            return;
        }
        // To the right of the point as seen along the ray: left of an upward edge, right of a
        // downward one.
        const bool upward = to.y > from.y;
        if ((orientation(from, to, p) > 0) == upward) {
            inside = !inside;
        }
    });
    return inside;
}

Nearest ShapeOracle::nearest_local(std::uint32_t edge, const Vector2& local) const {
    const auto& [from, to] = tree_.edges()[edge];
    const Vector2 along = minus(to, from);
    const double squared_length = dot(along, along);
    const double t = squared_length > 0.0 ? dot(minus(local, from), along) / squared_length : 0.0;
    Nearest result;
    if (t <= 0.0) {
        result.point = from;
        result.feature = {Feature::Kind::vertex, edge};
    } else if (t >= 1.0) {
        result.point = to;
        result.feature = {Feature::Kind::vertex, next_[edge]};
    } else {
        result.point = plus(from, times(along, t));
        result.feature = {Feature::Kind::edge, edge};
    }
    result.distance = distance(local, result.point);
    return result;
}

Nearest ShapeOracle::nearest_on_edge(std::uint32_t edge, const Vector2& point) const {
    Nearest result = nearest_local(edge, minus(point, origin_));
    result.point = plus(result.point, origin_);
    return result;
}

Nearest ShapeOracle::nearest(const Vector2& point) const {
    const Vector2 local = minus(point, origin_);
    Nearest best;
    best.distance = std::numeric_limits<double>::infinity();
    tree_.visit_nearest(local, best.distance, [&](std::uint32_t edge) {
        const Nearest here = nearest_local(edge, local);
        if (here.distance < best.distance) {
            best = here;
        }
        return best.distance;
    });
    best.point = plus(best.point, origin_);
    return best;
}

double ShapeOracle::signed_distance(const Vector2& point) const {
    const double distance = nearest(point).distance;
    return contains(point) ? -distance : distance;
}

std::vector<Nearest> ShapeOracle::edges_within(const Vector2& point, double radius) const {
    const Vector2 local = minus(point, origin_);
    std::vector<Nearest> result;
    tree_.visit_nearest(local, radius, [&](std::uint32_t edge) {
        Nearest here = nearest_local(edge, local);
        if (here.distance <= radius) {
            here.point = plus(here.point, origin_);
            result.push_back(here);
        }
        return radius;
    });
    return result;
}

bool ShapeOracle::has_length(std::uint32_t edge) const {
    const auto& [from, to] = tree_.edges()[edge];
    return !(from == to);
}

std::vector<Nearest> ShapeOracle::local_minima_within(const Vector2& point, double radius) const {
    std::vector<Nearest> result;
    for (const Nearest& candidate : edges_within(point, radius)) {
        if (candidate.feature.kind == Feature::Kind::vertex) {
            // Zero-length edges between repeated vertices are skipped on both sides.
            std::uint32_t after = candidate.feature.index;
            std::uint32_t before = previous_[after];
            while (!has_length(after) && next_[after] != candidate.feature.index) {
                after = next_[after];
            }
            while (!has_length(before) && before != candidate.feature.index) {
                before = previous_[before];
            }
            const double reach = candidate.distance * (1.0 - 1e-15);
            if (nearest_on_edge(after, point).distance < reach ||
                nearest_on_edge(before, point).distance < reach) {
                continue;
            }
        }
        result.push_back(candidate);
    }
    return result;
}

Vector2 ShapeOracle::vertex(std::uint32_t i) const {
    return plus(vertices_[i], origin_);
}

Rectangle ShapeOracle::box() const {
    return {plus(tree_.box().min, origin_), plus(tree_.box().max, origin_)};
}

double ShapeOracle::perimeter() const {
    double sum = 0.0;
    for (const Edge& edge : tree_.edges()) {
        sum += distance(edge.from, edge.to);
    }
    return sum;
}

}  // namespace nearfield::oracle
