#pragma once

#include <engine/geometry/vertex_kernels.hpp>

#include <cstddef>
#include <cstdint>

/// \file
/// The loops over edges and points that dominate the exact queries, vectorised: compiled for each
/// instruction set that the compiler supports and selected at run time for the machine. Results are
/// bit-identical on all of them: no product is fused with a sum.

namespace nearfield::simd {

/// Kernels may read (but not use) edge and point arrays up to a multiple of this: the number of
/// doubles in the widest vector.
inline constexpr std::size_t max_lanes = 8;
[[nodiscard]] constexpr std::size_t padded(std::size_t count) {
    return (count + max_lanes - 1) / max_lanes * max_lanes;
}

using geometry::Extent;

/// Points as a structure of arrays.
struct PointArrays {
    std::uint32_t count = 0;
    const double* x = nullptr;
    const double* y = nullptr;
};

/// Output arrays for points; each needs a capacity of padded(number of points tested).
struct FoundPoints {
    double* x = nullptr;
    double* y = nullptr;
};

/// Edges as a structure of arrays. Arrays are padded to whole lanes with a zero-length edge at the
/// last edge's end. Except for contain() and find_points_inside(), which count crossings, the
/// padding may instead repeat any edge of the array.
struct EdgeArrays {
    std::uint32_t count = 0;
    const double* start_x = nullptr;
    const double* start_y = nullptr;
    const double* end_x = nullptr;
    const double* end_y = nullptr;
    const double* inverse_length = nullptr;  ///< 1 / squared length, 0 for zero length

    /// The start points of the edges.
    [[nodiscard]] PointArrays starts() const { return {count, start_x, start_y}; }
};

/// An edge and its squared distance from a point, up to rounding.
struct NearEdge {
    std::uint32_t edge = 0;
    double squared = 0.0;
};

/// The nearest edge to a point, and a bound on the distance of the others.
struct NearestOfEdges : NearEdge {
    double second_squared = 0.0;  ///< squared lower bound for all other edges, up to rounding
};

/// An edge of each of two arrays.
struct EdgePair {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
};

/// A squared distance clearly above `limit` squared, whatever the kernels rounded.
[[nodiscard]] inline double beyond_rounding(double limit) {
    return 1.001 * limit * limit;
}

namespace kernels {

// Lists are written in ascending order to arrays with a capacity of padded(count) entries; the
// number of entries is returned.

/// Writes EdgeArrays::inverse_length for whole lanes.
void find_inverse_lengths(const EdgeArrays& edges, double* inverse_length);

/// Writes the points in a closed box, in order; returns their number.
[[nodiscard]] std::uint32_t find_points_in(const PointArrays& points, const Extent& box,
                                           const FoundPoints& found);

/// Writes the points of a closed box that are inside the edges by the even-odd rule, in order, and
/// returns their number; the result is unspecified for points on an edge. `crossed`: scratch with a
/// capacity of padded(edges.count) entries.
[[nodiscard]] std::uint32_t find_points_inside(const PointArrays& points, const Extent& box,
                                               const EdgeArrays& edges, std::uint32_t* crossed,
                                               const FoundPoints& found);

/// True if a point is inside the edges by the even-odd rule.
[[nodiscard]] bool contain(const EdgeArrays& edges, double x, double y);

/// Returns the edge nearest to a point; of equally near ones the first. Precondition: at least one
/// edge.
[[nodiscard]] NearestOfEdges find_nearest(const EdgeArrays& edges, double x, double y);

/// Lists the edges whose squared distance from a point is at most `most`, up to rounding.
[[nodiscard]] std::uint32_t find_edges_within(const EdgeArrays& edges, double x, double y,
                                              double most, std::uint32_t* found);

/// Lists the edges whose boxes intersect a box.
[[nodiscard]] std::uint32_t find_edges_in(const EdgeArrays& edges, const Extent& box,
                                          std::uint32_t* found);

/// Advances `pair` to the next pair, itself included, that may be at most `margin` apart: finds all
/// such pairs and hardly any others. Ordered by first edge, then second. Returns false if there are
/// no more.
[[nodiscard]] bool find_intersecting_pair(const EdgeArrays& first, const EdgeArrays& second,
                                          double margin, EdgePair& pair);

}  // namespace kernels

}  // namespace nearfield::simd
