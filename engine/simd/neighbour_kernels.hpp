#pragma once

#include <engine/simd/edge_kernels.hpp>

namespace nearfield::simd {

/// Edges, each with its neighbours on the ring, as a structure of arrays with the padding that
/// kernels need: where the edge before starts, where the edge starts and ends, and where the edge
/// after ends.
struct NeighbourArrays {
    const double* x[4] = {};
    const double* y[4] = {};
};

/// Output arrays for the nearest points; each needs a capacity of padded(number of points).
struct NearestOfNeighbours {
    double* x = nullptr;
    double* y = nullptr;
    double* distance = nullptr;
    double* parameter = nullptr;
    double* edge = nullptr;  ///< -1: the edge before, 0: the edge, 1: the edge after
};

namespace kernels {

/// Writes the nearest point of each point's own edge, bit for bit as geometry::nearest_on_segment()
/// computes it; of `with_neighbours`, that of the nearest of the three edges: of equally near ones
/// the edge itself, then the edge before.
void find_nearest_of_neighbours(const PointArrays& points, const NeighbourArrays& edges,
                                bool with_neighbours, const NearestOfNeighbours& nearest);

}  // namespace kernels

}  // namespace nearfield::simd
