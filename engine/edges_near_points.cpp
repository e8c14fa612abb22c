#include <engine/edges_near_points.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield {
namespace {

/// So many points are worth a look at which edges are near them.
constexpr std::size_t few_points = 4;

}  // namespace

void EdgesNearPoints::pick(const exact::PointArrays& points, std::span<const std::uint32_t> listed,
                           const exact::PlacedEdges& edges, double margin) {
    is_picked_ = listed.size() > few_points;
    if (!is_picked_) {
        edges_ = edges;
        return;
    }
    geometry::Box box;
    for (const std::uint32_t i : listed) {
        box.extend(geometry::Vector(points.x[i], points.y[i]));
    }
    // From the middle of all points it is this far to an edge, so from each not half a diagonal
    // farther; a little more, for rounding.
    const geometry::Vector middle = box.center();
    const double to_edge =
        std::sqrt(exact::kernels::find_nearest(edges, middle.x(), middle.y()).squared);
    const double reach = 1.001 * (to_edge + 0.5 * box.diagonal().norm() + margin) + edges.rounding;
    box.min().array() -= reach;
    box.max().array() += reach;
    picked_.pick(edges, exact::extent_of(box));
    edges_ = picked_.edges();
}

}  // namespace nearfield
