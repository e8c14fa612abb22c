#include <engine/exact/closest_edges.hpp>
#include <engine/geometry/segment.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::exact {
namespace {

using geometry::NearestOnSegment;
using geometry::Vector;

/// Of one vertex to the other shape: no less than the least distance.
double squared_bound(const PlacedEdges& vertices, const PlacedEdges& edges) {
    const std::uint32_t vertex =
        kernels::find_point_nearest_to(vertices.starts(), extent_of(edges.box));
    return kernels::find_nearest(edges, vertices.start_x[vertex], vertices.start_y[vertex]).squared;
}

/// The square of a length that is longer by so much.
double square_longer(double squared, double by) {
    const double longer = std::sqrt(squared) + by;
    return longer * longer;
}

NearestOnSegment nearest(const PlacedEdges& edges, std::uint32_t edge, const Vector& point) {
    return geometry::nearest_on_segment(point, edges.start(edge), edges.end(edge));
}

}  // namespace

void ClosestEdges::Near::find(const PlacedEdges& from, const PlacedEdges& edges, double most) {
    count = kernels::find_points_within(from.starts(), extent_of(edges.box), most, vertices.data());
    kernels::find_distances(from.starts(), vertices.data(), count, edges, squared.data());
}

double ClosestEdges::Near::least() const {
    return count == 0 ? std::numeric_limits<double>::infinity()
                      : *std::min_element(squared.begin(), squared.begin() + count);
}

void ClosestEdges::find_near(const PlacedEdges& a, const PlacedEdges& b, double most) {
    most_ = most;
    of_a_.find(a, b, most);
    of_b_.find(b, a, most);
}

template <class Use>
void ClosestEdges::for_each_within(const Near& near, const PlacedEdges& vertices,
                                   const PlacedEdges& edges, double most, const Use& use) {
    for (std::uint32_t i = 0; i < near.count; ++i) {
        if (near.squared[i] > most) {
            continue;
        }
        const std::uint32_t vertex = near.vertices[i];
        const std::uint32_t count = kernels::find_edges_within(
            edges, vertices.start_x[vertex], vertices.start_y[vertex], most, edges_.data());
        for (std::uint32_t k = 0; k < count; ++k) {
            use(vertex, edges_[k]);
        }
    }
}

ClosestPair ClosestEdges::find(const PlacedEdges& a, const PlacedEdges& b) {
    // More than what the kernels, or placing the vertices, may have rounded.
    const double rounding = a.rounding + b.rounding;
    const double bound = std::min(squared_bound(a, b), squared_bound(b, a));
    find_near(a, b, square_longer(bound, rounding));
    const double least = std::min({bound, of_a_.least(), of_b_.least()});
    // Of all that may be the closest, which the kernels cannot tell apart, the closest.
    const double close = square_longer(least, rounding);
    ClosestPair best;
    for_each_within(of_a_, a, b, close, [&](std::uint32_t vertex, std::uint32_t edge) {
        const NearestOnSegment on_b = nearest(b, edge, a.start(vertex));
        if (on_b.squared_distance < best.squared_distance) {
            best = {vertex, edge,           a.start(vertex),      on_b.point,
                    0.0,    on_b.parameter, on_b.squared_distance};
        }
    });
    for_each_within(of_b_, b, a, close, [&](std::uint32_t vertex, std::uint32_t edge) {
        const NearestOnSegment on_a = nearest(a, edge, b.start(vertex));
        if (on_a.squared_distance < best.squared_distance) {
            best = {edge,           vertex, on_a.point,           b.start(vertex),
                    on_a.parameter, 0.0,    on_a.squared_distance};
        }
    });
    return best;
}

bool ClosestEdges::is_unique(const PlacedEdges& a, const PlacedEdges& b, const ClosestPair& closest,
                             Side side, double margin, double apart) {
    const double limit = square_longer(closest.squared_distance, margin);
    const double squared_apart = apart * apart;
    bool unique = true;
    const auto consider = [&](const Vector& on_a, const Vector& on_b, double squared) {
        const bool elsewhere =
            (on_a - closest.point_a).squaredNorm() > squared_apart ||
            (side == Side::either && (on_b - closest.point_b).squaredNorm() > squared_apart);
        unique = unique && !(squared <= limit && elsewhere);
    };
    const double loose = square_longer(limit, a.rounding + b.rounding);
    if (loose > most_) {
        find_near(a, b, loose);
    }
    for_each_within(of_a_, a, b, loose, [&](std::uint32_t vertex, std::uint32_t edge) {
        const NearestOnSegment on_b = nearest(b, edge, a.start(vertex));
        consider(a.start(vertex), on_b.point, on_b.squared_distance);
    });
    if (unique) {
        for_each_within(of_b_, b, a, loose, [&](std::uint32_t vertex, std::uint32_t edge) {
            const NearestOnSegment on_a = nearest(a, edge, b.start(vertex));
            consider(on_a.point, b.start(vertex), on_a.squared_distance);
        });
    }
    return unique;
}

}  // namespace nearfield::exact
