#include <engine/geometry/segment.hpp>
#include <engine/queries/tile_edges.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::queries {

using geometry::Vector;

double TileBoundary::distance(const Vector& point, std::uint32_t edge) const {
    return std::sqrt(geometry::nearest_on_segment(point, start(edge), end(edge)).squared_distance);
}

double TileBoundary::distance(const Vector& point) const {
    // Start from a good guess, then visit everything that can be nearer.
    const Vector local = to_cells_.inverse(point);
    const std::uint32_t guess = simplified_.descend(
        [&](const geometry::Box& box) { return box.squaredExteriorDistance(local); });
    double nearest = distance(point, guess);
    const auto boxes_nearer = [&](const geometry::Box& box, std::uint32_t, std::uint32_t) {
        return to_cells_.cells(box.exteriorDistance(local)) <= nearest + rounding_;
    };
    simplified_.traverse(boxes_nearer, [&](std::uint32_t edge) {
        nearest = std::min(nearest, distance(point, edge));
    });
    return nearest;
}

namespace {

/// Appends an edge that starts or ends left of `right`. If the edge may be cut, its part beyond
/// `right` is replaced by a vertical edge in the same rows, so that no coordinate grows large.
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

/// Joins consecutive edges that stay right of a tile into vertical ones.
class RightOfTile {
public:
    RightOfTile(const TileBoundary& boundary, double x, double low, double high,
                std::vector<TileEdge>& edges)
        : boundary_(&boundary), x_(x), low_(low), high_(high), edges_(&edges) {}

    /// Adds the edges first, ..., end - 1; calls must come in order.
    void add(std::uint32_t first, std::uint32_t end) {
        const SimplifiedBoundary& simplified = boundary_->simplified();
        const auto ring_of = simplified.ring_of;
        if (first != end_) {
            close();
            first_ = first;
        }
        if (ring_of[end - 1] != ring_of[first_]) {
            // Whole rings in between cross every row an even number of times.
            end_ = simplified.ring_begin[ring_of[first_] + 1];
            close();
            first_ = simplified.ring_begin[ring_of[end - 1]];
        }
        end_ = end;
    }

    /// Appends the edge joined so far.
    void close() {
        if (first_ < end_) {
            const Vector a(x_, boundary_->start(first_).y());
            const Vector b(x_, boundary_->end(end_ - 1).y());
            if (a.y() != b.y() && std::max(a.y(), b.y()) >= low_ &&
                std::min(a.y(), b.y()) <= high_) {
                edges_->push_back({a, b, no_simplified});
            }
        }
        first_ = end_;
    }

private:
    const TileBoundary* boundary_;
    double x_;
    double low_;
    double high_;
    std::vector<TileEdge>* edges_;
    std::uint32_t first_ = 0;  // of the chain that is being joined
    std::uint32_t end_ = 0;
};

}  // namespace

void crossing_edges(const TileBoundary& boundary, std::uint32_t width, std::uint32_t height,
                    double slack, std::vector<TileEdge>& edges) {
    const double left = -1.0 - slack;
    const double right = width + 1.0 + slack;
    const double low = -1.0 - slack;
    const double high = height + 1.0 + slack;
    RightOfTile beyond(boundary, right, low, high, edges);
    const auto enter = [&](const geometry::Box& box, std::uint32_t first, std::uint32_t end) {
        const geometry::Box cells = boundary.in_cells(box);
        if (cells.min().x() > right) {
            beyond.add(first, end);
            return false;
        }
        return cells.max().y() >= low && cells.min().y() <= high && cells.max().x() >= left;
    };
    boundary.simplified().traverse(enter, [&](std::uint32_t i) {
        const Vector a = boundary.start(i);
        const Vector b = boundary.end(i);
        if (std::min(a.x(), b.x()) > right) {
            beyond.add(i, i + 1);
        } else if (std::max(a.y(), b.y()) >= low && std::min(a.y(), b.y()) <= high &&
                   std::max(a.x(), b.x()) >= left) {
            beyond.close();
            push_upright_beyond(right, {a, b, i}, boundary.edge(i).count == 1, edges);
        }
    });
    beyond.close();
}

}  // namespace nearfield::queries
