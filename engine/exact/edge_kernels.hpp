#pragma once

#include <engine/geometry/vertex_kernels.hpp>

#include <cstddef>
#include <cstdint>

/// \file
/// The loops over edges and points that the exact answers spend their time in, several at once:
/// compiled for every instruction set that the compiler knows, chosen at run time for the machine.
/// Every one rounds the same on all of them: no product is fused with a sum.

namespace nearfield::exact {

/// Arrays of edges and points may be read, not used, up to a multiple of this: as many doubles as
/// the widest vector has.
inline constexpr std::size_t most_lanes = 8;
[[nodiscard]] constexpr std::size_t padded(std::size_t count) {
    return (count + most_lanes - 1) / most_lanes * most_lanes;
}

using geometry::Extent;

/// Points, an array for each coordinate.
struct PointArrays {
    std::uint32_t count = 0;
    const double* x = nullptr;
    const double* y = nullptr;
};

/// Where points that are found are written; room for padded(how many are looked at).
struct FoundPoints {
    double* x = nullptr;
    double* y = nullptr;
};

/// Edges, an array for each coordinate of their ends. What fills an array up to whole lanes is an
/// edge of no length at the last edge's end; or, but for contain() and find_points_inside(), which
/// count crossings, any edge of the array once more.
struct EdgeArrays {
    std::uint32_t count = 0;
    const double* start_x = nullptr;
    const double* start_y = nullptr;
    const double* end_x = nullptr;
    const double* end_y = nullptr;
    const double* inverse_length = nullptr;  ///< 1 / squared length, 0 for no length

    /// Where the edges start.
    [[nodiscard]] PointArrays starts() const { return {count, start_x, start_y}; }
};

/// An edge and its squared distance from a point, up to rounding.
struct NearEdge {
    std::uint32_t edge = 0;
    double squared = 0.0;
};

/// The nearest edge to a point, and how far the others are.
struct NearestOfEdges : NearEdge {
    double second_squared = 0.0;  ///< no other is nearer than its root, up to rounding
};

/// An edge of each of two arrays.
struct EdgePair {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
};

namespace kernels {

// Lists are written to arrays with room for padded(count) entries, in ascending order; the number
// of entries is returned.

/// Writes EdgeArrays::inverse_length of whole lanes.
void find_inverse_lengths(const EdgeArrays& edges, double* inverse_length);

/// Finds the points in a closed box, in order; returns how many there are.
[[nodiscard]] std::uint32_t find_points_in(const PointArrays& points, const Extent& box,
                                           const FoundPoints& found);

/// Finds the points in a closed box that lie inside the edges by the odd-even rule, in order; for
/// points on an edge either answer may come. Returns how many there are. `crossed`: scratch with
/// room for padded(edges.count) entries.
[[nodiscard]] std::uint32_t find_points_inside(const PointArrays& points, const Extent& box,
                                               const EdgeArrays& edges, std::uint32_t* crossed,
                                               const FoundPoints& found);

/// By the odd-even rule, of one point.
[[nodiscard]] bool contain(const EdgeArrays& edges, double x, double y);

/// The edge nearest to a point, of equally near ones the first. At least one edge.
[[nodiscard]] NearestOfEdges find_nearest(const EdgeArrays& edges, double x, double y);

/// Lists the edges whose squared distance from a point is up to rounding at most `most`.
[[nodiscard]] std::uint32_t find_edges_within(const EdgeArrays& edges, double x, double y,
                                              double most, std::uint32_t* found);

/// Lists the edges whose boxes meet a box.
[[nodiscard]] std::uint32_t find_edges_in(const EdgeArrays& edges, const Extent& box,
                                          std::uint32_t* found);

/// Moves `pair` to the next one, itself included, that may come as close together as `margin`: all
/// do that are, and hardly any other. By first edges, then second. False where there is no more.
[[nodiscard]] bool find_meeting_pair(const EdgeArrays& first, const EdgeArrays& second,
                                     double margin, EdgePair& pair);

/// The point nearest to a box; of equally near ones the first. At least one point.
[[nodiscard]] std::uint32_t find_point_nearest_to(const PointArrays& points, const Extent& box);

}  // namespace kernels

}  // namespace nearfield::exact
