#include <embedded/iceland_10m.hpp>
#include <embedded/ireland_10m.hpp>
#include <tools/benchmark/coast_lines.hpp>
#include <tools/benchmark/objects.hpp>
#include <tools/io/geojson.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

namespace nearfield::benchmark {
namespace {

struct Edge {
    Vector2 from;
    Vector2 to;
};

std::vector<Edge> edges_of(const std::vector<Ring>& rings) {
    std::vector<Edge> edges;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
        }
    }
    return edges;
}

/// The signed distance along x from the point to the edge at the point's height; `nothing` if the
/// edge does not span that height.
double ahead_of(Vector2 point, const Edge& edge, double nothing) {
    if (point.y < std::min(edge.from.y, edge.to.y) || point.y > std::max(edge.from.y, edge.to.y)) {
        return nothing;
    }
    if (edge.from.y == edge.to.y) {
        return std::min(edge.from.x, edge.to.x) - point.x;
    }
    const double t = (point.y - edge.from.y) / (edge.to.y - edge.from.y);
    return std::lerp(edge.from.x, edge.to.x, t) - point.x;
}

/// GeoJSON closes its rings with the first vertex again.
std::vector<Ring> opened(std::vector<Ring> rings) {
    for (Ring& ring : rings) {
        if (ring.front() == ring.back()) {
            ring.pop_back();
        }
    }
    return rings;
}

double width_of(const std::vector<Ring>& rings) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            low = std::min(low, vertex.x);
            high = std::max(high, vertex.x);
        }
    }
    return high - low;
}

}  // namespace

std::vector<Ring> iceland() {
    return opened(tools::parse_geojson(embedded::iceland_10m, "iceland_10m.geojson"));
}

std::vector<Ring> ireland() {
    return opened(tools::parse_geojson(embedded::ireland_10m, "ireland_10m.geojson"));
}

double gap_along_x(const std::vector<Ring>& a, const std::vector<Ring>& b) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // The smallest gap is attained at a vertex of one of the two outlines.
    double gap = infinity;
    const std::vector<Edge> edges_a = edges_of(a);
    const std::vector<Edge> edges_b = edges_of(b);
    for (const Edge& edge_a : edges_a) {
        for (const Edge& edge_b : edges_b) {
            gap = std::min(gap, ahead_of(edge_a.from, edge_b, infinity));
            gap = std::min(gap, -ahead_of(edge_b.from, edge_a, -infinity));
        }
    }
    return gap;
}

tools::Scene coast_lines_scene(double overlap) {
    const std::vector<Ring> a = iceland();
    std::vector<Ring> b = ireland();
    const double width = width_of(a);
    // B starts to the right of all of A, so that the first touch is the relevant one.
    const double start = width + width_of(b);
    for (Ring& ring : b) {
        for (Vector2& vertex : ring) {
            vertex.x += start;
        }
    }
    const double gap = gap_along_x(a, b);
    tools::Scene scene;
    add_object(scene, a, {});
    add_object(scene, ireland(), {{start - gap - overlap * width, 0.0}, 0.0});
    return scene;
}

}  // namespace nearfield::benchmark
