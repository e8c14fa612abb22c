#include "boundary.hpp"

#include <tests/oracle/plane.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace nearfield::oracle {
namespace {

struct Piece {
    Edge edge;
    Vector2 middle;
    double depth = 0.0;  // at the middle
    double upper = 0.0;

    friend bool operator<(const Piece& a, const Piece& b) { return a.upper < b.upper; }
};

Piece make_piece(const Edge& edge, const ShapeOracle& b) {
    Piece piece{edge, times(plus(edge.from, edge.to), 0.5), 0.0, 0.0};
    piece.depth = b.depth(piece.middle);
    piece.upper = piece.depth + distance(edge.from, edge.to) / 2;
    return piece;
}

/// The crossing of the open segments as a parameter along `a`; negative if there is none.
double crossing_parameter(const Edge& a, const Edge& b) {
    const long double from = orientation(b.from, b.to, a.from);
    const long double to = orientation(b.from, b.to, a.to);
    const long double low = orientation(a.from, a.to, b.from);
    const long double high = orientation(a.from, a.to, b.to);
    const bool cross = ((from > 0 && to < 0) || (from < 0 && to > 0)) &&
                       ((low > 0 && high < 0) || (low < 0 && high > 0));
    return cross ? static_cast<double>(from / (from - to)) : -1.0;
}

}  // namespace

Deepest deepest_on_boundary(const ShapeOracle& a, const ShapeOracle& b, double accuracy) {
    Deepest best;
    best.depth = -std::numeric_limits<double>::infinity();
    std::priority_queue<Piece> open;
    const auto consider = [&](const Edge& edge) {
        const Piece piece = make_piece(edge, b);
        if (piece.depth > best.depth) {
            best.point = piece.middle;
            best.depth = piece.depth;
        }
        open.push(piece);
    };
    for (std::uint32_t i = 0; i < a.size(); ++i) {
        consider({a.vertex(i), a.vertex(a.next(i))});
    }
    while (open.top().upper > std::max(best.depth, 0.0) + accuracy) {
        const Piece piece = open.top();
        open.pop();
        consider({piece.edge.from, piece.middle});
        consider({piece.middle, piece.edge.to});
    }
    best.upper = std::max(open.top().upper, best.depth);
    return best;
}

Deepest deepest_vertex(const ShapeOracle& a, const ShapeOracle& b) {
    Deepest best;
    best.depth = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < a.size(); ++i) {
        const double depth = b.depth(a.vertex(i));
        if (depth > best.depth) {
            best.point = a.vertex(i);
            best.depth = depth;
        }
    }
    best.upper = best.depth;
    return best;
}

std::vector<Vector2> sample_boundary(const ShapeOracle& shape, double spacing, std::size_t most) {
    spacing = std::max(spacing, shape.perimeter() / static_cast<double>(most));
    std::vector<Vector2> points;
    for (std::uint32_t i = 0; i < shape.size(); ++i) {
        const Vector2 from = shape.vertex(i);
        const Vector2 along = minus(shape.vertex(shape.next(i)), from);
        const double steps = std::max(1.0, std::ceil(length(along) / spacing));
        for (double step = 0.0; step < steps; step += 1.0) {
            points.push_back(plus(from, times(along, step / steps)));
        }
    }
    return points;
}

std::vector<Vector2> crossings(const ShapeOracle& a, const ShapeOracle& b, std::size_t most) {
    const Vector2 shift = minus(a.origin(), b.origin());
    std::vector<Vector2> points;
    for (const Edge& edge : a.local_edges().edges()) {
        const Edge moved{plus(edge.from, shift), plus(edge.to, shift)};
        const Rectangle box{
            {std::min(moved.from.x, moved.to.x), std::min(moved.from.y, moved.to.y)},
            {std::max(moved.from.x, moved.to.x), std::max(moved.from.y, moved.to.y)}};
        b.local_edges().visit_box(box, [&](std::uint32_t other) {
            const double t = crossing_parameter(moved, b.local_edges().edges()[other]);
            if (t >= 0.0 && points.size() < most) {
                const Vector2 local = plus(moved.from, times(minus(moved.to, moved.from), t));
                points.push_back(plus(local, b.origin()));
            }
        });
    }
    return points;
}

}  // namespace nearfield::oracle
