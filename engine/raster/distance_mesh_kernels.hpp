#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/vector.hpp>

#include <cstddef>

/// \file The vertices of a distance mesh, with SIMD: compiled for several instruction sets, of
/// which the best that the machine supports is selected at run time. All give the same bits.

namespace nearfield::raster {

using geometry::Box;
using geometry::MeshVertex;
using geometry::SubpixelGrid;
using geometry::Vector;

namespace kernels {

inline constexpr std::size_t pieces_at_once = 8;
inline constexpr std::size_t piece_corners = 4;
inline constexpr std::size_t piece_triangles = 2;

/// Flat pieces of a distance mesh: convex polygons on planes. A plane is 0 at the origin. The
/// corners are those of a quad, or of a triangle whose last two coincide.
struct Pieces {
    double origin_x[pieces_at_once];
    double origin_y[pieces_at_once];
    double gradient_x[pieces_at_once];
    double gradient_y[pieces_at_once];
    double x[piece_corners][pieces_at_once];
    double y[piece_corners][pieces_at_once];
};

/// The same corners snapped, and the distances there: the planes', so that snapping does not tilt
/// them, and at least 0, where depth ranges start.
struct PlacedPieces {
    float x[piece_corners][pieces_at_once];
    float y[piece_corners][pieces_at_once];
    float distance[piece_corners][pieces_at_once];
    /// 0: the triangle (corners 0, 1, 2 or 0, 2, 3) has no area, or lies on one side of the box.
    float needed[piece_triangles][pieces_at_once];
};

/// Places `count` pieces; `placed` has as many elements as `pieces`. Returns the largest distance.
[[nodiscard]] float place_pieces(const Pieces* pieces, std::size_t count, SubpixelGrid grid,
                                 const Box& within, PlacedPieces* placed);

}  // namespace kernels
}  // namespace nearfield::raster
