#include <engine/geometry/segment.hpp>
#include <engine/world/deepest_vertex.hpp>

#include <cmath>
#include <limits>

namespace nearfield::world {

using geometry::Vector;

std::optional<DeepVertex> DeepestVertex::find(const simd::TransformedEdges& inner,
                                              const simd::TransformedEdges& outer) {
    if (x_.size() < simd::padded(inner.count)) {
        x_.resize(simd::padded(inner.count));
        y_.resize(simd::padded(inner.count));
    }
    const std::uint32_t count = simd::kernels::find_points_in(
        inner.starts(), geometry::extent_of(outer.box), {x_.data(), y_.data()});
    const simd::AabbTree tree = outer.tree();
    std::optional<DeepVertex> deepest;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector vertex(x_[i], y_[i]);
        if (!simd::kernels::contain(tree, vertex.x(), vertex.y())) {
            continue;
        }
        const std::uint32_t edge =
            simd::kernels::find_nearer(tree, vertex.x(), vertex.y(),
                                       {0, std::numeric_limits<double>::infinity()})
                .edge;
        const geometry::NearestOnSegment nearest =
            geometry::nearest_on_segment(vertex, outer.start(edge), outer.end(edge));
        const double depth = std::sqrt(nearest.squared_distance);
        if (!deepest || depth > deepest->depth) {
            deepest = {depth, vertex, nearest.point};
        }
    }
    return deepest;
}

}  // namespace nearfield::world
