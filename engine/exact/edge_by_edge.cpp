#include <engine/exact/edge_by_edge.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace nearfield::exact {

using geometry::Vector;

NearestPoint nearest(const PlacedEdges& edges, const Vector& point) {
    const std::uint32_t edge = kernels::find_nearest(edges, point.x(), point.y()).edge;
    return {edge, geometry::nearest_on_segment(point, edges.start(edge), edges.end(edge))};
}

bool is_unique(const EdgeArrays& edges, const Vector& point, const NearestPoint& nearest,
               double margin) {
    const double limit = std::sqrt(nearest.on_edge.squared_distance) + margin;
    std::array<std::uint32_t, padded(most_edges_one_by_one)> near;
    // What is clearly farther needs no closer look.
    const std::uint32_t count = kernels::find_edges_within(edges, point.x(), point.y(),
                                                           beyond_rounding(limit), near.data());
    if (count <= 1) {
        return true;  // none but the nearest
    }
    return std::none_of(near.begin(), near.begin() + count, [&](std::uint32_t i) {
        const Vector start(edges.start_x[i], edges.start_y[i]);
        const Vector end(edges.end_x[i], edges.end_y[i]);
        return is_rival(geometry::nearest_on_segment(point, start, end), nearest.on_edge, limit);
    });
}

}  // namespace nearfield::exact
