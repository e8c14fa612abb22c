#include <engine/narrowphase/brute_force.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace nearfield::narrowphase {

using geometry::Vector;

NearestPoint nearest(const simd::TransformedEdges& edges, const Vector& point) {
    const std::uint32_t edge = simd::kernels::find_nearest(edges, point.x(), point.y()).edge;
    return {edge, geometry::nearest_on_segment(point, edges.start(edge), edges.end(edge))};
}

bool is_unique(const simd::EdgeArrays& edges, const Vector& point, const NearestPoint& nearest,
               double margin) {
    const double limit = std::sqrt(nearest.on_edge.squared_distance) + margin;
    std::array<std::uint32_t, simd::padded(simd::max_edges_one_by_one)> near;
    // Skips edges that are clearly farther away.
    const std::uint32_t count = simd::kernels::find_edges_within(
        edges, point.x(), point.y(), simd::beyond_rounding(limit), near.data());
    if (count <= 1) {
        return true;  // only the nearest
    }
    return std::none_of(near.begin(), near.begin() + count, [&](std::uint32_t i) {
        const Vector start(edges.start_x[i], edges.start_y[i]);
        const Vector end(edges.end_x[i], edges.end_y[i]);
        return is_rival(geometry::nearest_on_segment(point, start, end), nearest.on_edge, limit);
    });
}

}  // namespace nearfield::narrowphase
