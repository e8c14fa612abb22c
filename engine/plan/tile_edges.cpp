#include <engine/geometry/segment.hpp>
#include <engine/plan/tile_edges.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::plan {

using geometry::Vector;

void TileBoundary::place(const geometry::Polygon& shape,
                         const std::vector<geometry::SimplifiedEdge>& simplified,
                         const ToCells& to_cells) {
    polygon = &shape;
    edges = &simplified;
    const auto count = static_cast<std::uint32_t>(simplified.size());
    starts.resize(count);
    next.resize(count);
    previous.resize(count);
    std::uint32_t ring_start = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        starts[i] = to_cells(shape.vertices()[simplified[i].first]);
        // A ring's last edge ends where its first one starts.
        const bool closes = simplified[i].last == simplified[ring_start].first;
        next[i] = closes ? ring_start : i + 1;
        previous[next[i]] = i;
        if (closes) {
            ring_start = i + 1;
        }
    }
}

double TileBoundary::distance(const Vector& point) const {
    double squared = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < size(); ++i) {
        squared = std::min(squared,
                           geometry::nearest_on_segment(point, start(i), end(i)).squared_distance);
    }
    return std::sqrt(squared);
}

namespace {

/// Appends an edge that starts or ends left of `right`. What of an edge that may be cut lies right
/// of it is replaced by an upright edge in the same rows, so that no coordinate grows large.
void push_upright_beyond(double right, const TileEdge& edge, bool may_be_cut,
                         std::vector<TileEdge>& edges) {
    if (!may_be_cut || std::max(edge.a.x(), edge.b.x()) <= right) {
        edges.push_back(edge);
        return;
    }
    const double t = (right - edge.a.x()) / (edge.b.x() - edge.a.x());
    const Vector cut(right, edge.a.y() + t * (edge.b.y() - edge.a.y()));
    if (edge.a.x() <= right) {
        edges.push_back({edge.a, cut, edge.simplified});
        edges.push_back({cut, Vector(right, edge.b.y()), no_simplified});
    } else {
        edges.push_back({Vector(right, edge.a.y()), cut, no_simplified});
        edges.push_back({cut, edge.b, edge.simplified});
    }
}

}  // namespace

void crossing_edges(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
                    double slack, std::vector<TileEdge>& edges) {
    const double left = -1.0 - slack;
    const double right = width + 1.0 + slack;
    const double low = -1.0 - slack;
    const double high = height + 1.0 + slack;
    const std::uint32_t count = boundary.size();
    std::uint32_t i = 0;
    while (i < count) {
        const Vector& a = boundary.start(i);
        const Vector& b = boundary.end(i);
        if (std::max(a.y(), b.y()) < low || std::min(a.y(), b.y()) > high ||
            std::max(a.x(), b.x()) < left) {
            ++i;
            continue;
        }
        if (std::min(a.x(), b.x()) <= right) {
            push_upright_beyond(right, {a, b, i}, (*boundary.edges)[i].count == 1, edges);
            ++i;
            continue;
        }
        // Join the chain that stays right of the tile, up to the end of its ring.
        std::uint32_t last = i;
        while (boundary.next[last] == last + 1 && boundary.end(last + 1).x() > right) {
            ++last;
        }
        const Vector chain_start(right, a.y());
        const Vector chain_end(right, boundary.end(last).y());
        if (chain_start.y() != chain_end.y()) {
            edges.push_back({chain_start, chain_end, no_simplified});
        }
        i = last + 1;
    }
}

}  // namespace nearfield::plan
