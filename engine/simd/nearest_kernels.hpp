#pragma once

#include <engine/simd/aabb_tree.hpp>
#include <engine/simd/division_memory.hpp>
#include <engine/simd/edge_kernels.hpp>

#include <cstdint>

namespace nearfield::simd {

/// The nearest feature of each point, as a structure of arrays. Distances of the other edges are
/// accurate up to rounding; the rest is as geometry::nearest_on_segment() computes it.
struct NearestArrays {
    double* x = nullptr;  ///< of the nearest point
    double* y = nullptr;
    double* distance = nullptr;
    double* parameter = nullptr;       ///< position of the nearest point on its edge
    double* second_squared = nullptr;  ///< of the second-nearest edge, if it is near
    double* third_squared = nullptr;   ///< squared lower bound for all other edges
    std::uint32_t* edge = nullptr;     ///< the nearest; of equally near ones the first
    std::uint32_t* second = nullptr;   ///< the second nearest
};

namespace kernels {

/// Finds the edge nearest to each point; of the other edges, those as near up to `margin`, and some
/// more. The closer together consecutive points are, the less work it takes. The arrays of points
/// and results need a capacity of max_lanes more than the number of points. `near`: scratch with a
/// capacity of padded(edges.count) entries.
void find_nearest_of(const PointArrays& points, const EdgeArrays& edges, double margin,
                     std::uint32_t* near, const NearestArrays& nearest);
/// Where boxes do not tell which edge is near, as for long slanted edges side by side, points and
/// edges are divided together in `memory`, whatever their order.
void find_nearest_of(const PointArrays& points, const AabbTree& tree, double margin,
                     std::uint32_t* near, DivisionMemory& memory, const NearestArrays& nearest);

}  // namespace kernels

}  // namespace nearfield::simd
