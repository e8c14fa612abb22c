#include <engine/simd/neighbour_kernels.hpp>

#include <cstddef>

// Highway compiles the rest once per instruction set by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/simd/neighbour_kernels.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <engine/simd/lanes-inl.hpp>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace nearfield::simd::kernels::HWY_NAMESPACE {

/// The edges between two consecutive vertices of the four.
HWY_INLINE EdgeLanes edges_from(const NeighbourArrays& edges, std::size_t vertex, std::size_t i) {
    const Tag tag;
    EdgeLanes lanes;
    lanes.start_x = hn::LoadU(tag, edges.x[vertex] + i);
    lanes.start_y = hn::LoadU(tag, edges.y[vertex] + i);
    lanes.end_x = hn::LoadU(tag, edges.x[vertex + 1] + i);
    lanes.end_y = hn::LoadU(tag, edges.y[vertex + 1] + i);
    return lanes;
}

/// Puts those of another edge in the place of the nearest points that are farther.
HWY_INLINE void compare(const NearestLanes& other, Lanes other_edge, NearestLanes& nearest,
                        Lanes& edge) {
    const LaneMask nearer = hn::Lt(other.squared, nearest.squared);
    nearest.x = hn::IfThenElse(nearer, other.x, nearest.x);
    nearest.y = hn::IfThenElse(nearer, other.y, nearest.y);
    nearest.parameter = hn::IfThenElse(nearer, other.parameter, nearest.parameter);
    nearest.squared = hn::IfThenElse(nearer, other.squared, nearest.squared);
    edge = hn::IfThenElse(nearer, other_edge, edge);
}

void FindNearestOfNeighbours(const PointArrays& points, const NeighbourArrays& edges,
                             bool with_neighbours, const NearestOfNeighbours& nearest) {
    const Tag tag;
    for (std::size_t i = 0; i < points.count; i += hn::Lanes(tag)) {
        const Lanes x = hn::LoadU(tag, points.x + i);
        const Lanes y = hn::LoadU(tag, points.y + i);
        NearestLanes found = nearest_on_edges(edges_from(edges, 1, i), x, y);
        Lanes edge = hn::Zero(tag);
        if (with_neighbours) {
            compare(nearest_on_edges(edges_from(edges, 0, i), x, y), hn::Set(tag, -1.0), found,
                    edge);
            compare(nearest_on_edges(edges_from(edges, 2, i), x, y), hn::Set(tag, 1.0), found,
                    edge);
        }
        hn::StoreU(found.x, tag, nearest.x + i);
        hn::StoreU(found.y, tag, nearest.y + i);
        hn::StoreU(hn::Sqrt(found.squared), tag, nearest.distance + i);
        hn::StoreU(found.parameter, tag, nearest.parameter + i);
        hn::StoreU(edge, tag, nearest.edge + i);
    }
}

}  // namespace nearfield::simd::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nearfield::simd::kernels {

HWY_EXPORT(FindNearestOfNeighbours);

void find_nearest_of_neighbours(const PointArrays& points, const NeighbourArrays& edges,
                                bool with_neighbours, const NearestOfNeighbours& nearest) {
    HWY_DYNAMIC_DISPATCH(FindNearestOfNeighbours)(points, edges, with_neighbours, nearest);
}

}  // namespace nearfield::simd::kernels
#endif
