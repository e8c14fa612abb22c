#include <tests/oracle/filled_region.hpp>
#include <tests/oracle/plane.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::oracle {
namespace {

Vector2 along(const Edge& edge, double part) {
    return plus(edge.from, times(minus(edge.to, edge.from), part));
}

/// Where on the edge the point nearest to `point` is, from 0 to 1.
double nearest_part(const Edge& edge, const Vector2& point) {
    const Vector2 way = minus(edge.to, edge.from);
    return std::clamp(dot(minus(point, edge.from), way) / dot(way, way), 0.0, 1.0);
}

double distance_to(const Edge& edge, const Vector2& point) {
    return distance(along(edge, nearest_part(edge, point)), point);
}

/// Adds where another edge crosses an edge, and where one of its ends is on it.
void add_cuts(const Edge& edge, const Edge& other, double resolution, std::vector<double>& cuts) {
    const long double from = orientation(other.from, other.to, edge.from);
    const long double to = orientation(other.from, other.to, edge.to);
    const long double a = orientation(edge.from, edge.to, other.from);
    const long double b = orientation(edge.from, edge.to, other.to);
    if ((from > 0) != (to > 0) && (a > 0) != (b > 0)) {
        cuts.push_back(static_cast<double>(from / (from - to)));
    }
    for (const Vector2& end : {other.from, other.to}) {
        const double part = nearest_part(edge, end);
        if (distance(along(edge, part), end) <= resolution) {
            cuts.push_back(part);
        }
    }
}

int winding(std::span<const Edge> ring, const Vector2& point) {
    int turns = 0;
    for (const Edge& edge : ring) {
        const bool is_up = edge.from.y <= point.y && edge.to.y > point.y;
        const bool is_down = edge.to.y <= point.y && edge.from.y > point.y;
        if (is_up && orientation(edge.from, edge.to, point) > 0) {
            ++turns;
        } else if (is_down && orientation(edge.from, edge.to, point) < 0) {
            --turns;
        }
    }
    return turns;
}

}  // namespace

FilledRegion::FilledRegion(std::span<const Ring> rings, FillRule rule) : rule_(rule) {
    double extent = 0.0;
    origin_ = rings.front().front();
    for (const Ring& ring : rings) {
        std::vector<Edge>& edges = edges_.emplace_back();
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Edge edge{minus(ring[i], origin_), minus(ring[(i + 1) % ring.size()], origin_)};
            extent = std::max(extent, length(edge.from));
            if (edge.from != edge.to) {
                edges.push_back(edge);
            }
        }
    }
    resolution_ = 1e-12 * extent;
    for (const std::vector<Edge>& ring : edges_) {
        for (const Edge& edge : ring) {
            add_pieces(edge);
        }
    }
}

void FilledRegion::add_pieces(const Edge& edge) {
    std::vector<double> cuts{0.0, 1.0};
    for (const std::vector<Edge>& ring : edges_) {
        for (const Edge& other : ring) {
            add_cuts(edge, other, resolution_, cuts);
        }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        add_piece(along(edge, cuts[i - 1]), along(edge, cuts[i]));
    }
}

void FilledRegion::add_piece(const Vector2& from, const Vector2& to) {
    const double size = length(minus(to, from));
    if (size <= resolution_) {
        return;
    }
    const Edge piece{from, to};
    const Vector2 middle = along(piece, 0.5);
    // As far beside it as no other edge comes between, unless it coincides.
    double beside = size;
    for (const std::vector<Edge>& ring : edges_) {
        for (const Edge& edge : ring) {
            const double gap = distance_to(edge, middle);
            beside = gap > resolution_ / 4.0 ? std::min(beside, gap) : beside;
        }
    }
    const Vector2 step = times(minus(to, from), 0.5 * beside / size);
    const bool left = has({middle.x - step.y, middle.y + step.x});
    const bool right = has({middle.x + step.y, middle.y - step.x});
    if (left != right) {
        boundary_.push_back(piece);
    } else if (left) {
        inner_.push_back(piece);
    }
}

bool FilledRegion::has(const Vector2& point) const {
    int total = 0;
    for (const std::vector<Edge>& ring : edges_) {
        const int turns = winding(ring, point);
        if (rule_ == FillRule::union_of_parts && turns % 2 != 0) {
            return true;
        }
        total += turns;
    }
    switch (rule_) {
        case FillRule::odd_even:
            return total % 2 != 0;
        case FillRule::nonzero:
            return total != 0;
        case FillRule::positive:
            return total > 0;
        case FillRule::union_of_parts:
            break;
    }
    return false;
}

bool FilledRegion::contains(const Vector2& point) const {
    return has(minus(point, origin_));
}

std::vector<Edge> FilledRegion::placed(std::vector<Edge> edges) const {
    for (Edge& edge : edges) {
        edge = {plus(edge.from, origin_), plus(edge.to, origin_)};
    }
    return edges;
}

double FilledRegion::distance(const Vector2& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Edge& piece : boundary_) {
        least = std::min(least, distance_to(piece, minus(point, origin_)));
    }
    return least;
}

double FilledRegion::signed_distance(const Vector2& point) const {
    // Edges that nearly coincide enclose slivers that are no part of the boundary, nor of this.
    const double gap = distance(point);
    const double step = std::min(0.5 * gap, 4.0 * resolution_);
    int inside = 0;
    for (const Vector2& way : {Vector2{0.8, 0.6}, Vector2{-0.96, 0.28}, Vector2{0.28, -0.96}}) {
        inside += contains(plus(point, times(way, step))) ? 1 : 0;
    }
    return inside >= 2 ? -gap : gap;
}

}  // namespace nearfield::oracle
