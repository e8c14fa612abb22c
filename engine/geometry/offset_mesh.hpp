#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/vector.hpp>

#include <array>
#include <optional>

namespace nearfield::geometry {

/// How far beyond the offset the offset polygon may extend, as a factor: 1 / cos(22.5 degrees),
/// because half octagons around half circles form its ends.
inline constexpr double offset_overreach = 1.0823922002923940;

/// Corners of an offset polygon, counter-clockwise and snapped. After snapping they need not be
/// convex: the polygon is the fan of triangles around the first corner.
using OffsetPolygon = std::array<Vector, 8>;

/// Returns the offset polygon of an edge that append_offset_polygon() appends, or nothing if the
/// edge cannot reach the tile.
[[nodiscard]] std::optional<OffsetPolygon> offset_polygon(const Vector& a, const Vector& b,
                                                          double offset, std::uint32_t width,
                                                          std::uint32_t height, SubpixelGrid grid);

/// Appends the offset polygon of edge ab (section 2.2.1 of the paper): six triangles of an octagon
/// stretched along the edge, with snapped vertices. It covers every sample of the tile within
/// `offset` of the edge and no point farther from it than `offset * offset_overreach + 3 *
/// grid.largest_move()`. A zero-length edge gives an octagon.
///
/// Uses only the part of the edge that can reach the tile of width x height cells, and appends
/// nothing if there is none: no vertex is farther from the tile (along an axis) than twice the
/// bound above, so no rasteriser has to clip.
void append_offset_polygon(const Vector& a, const Vector& b, double offset, std::uint32_t width,
                           std::uint32_t height, SubpixelGrid grid, std::uint32_t id, Mesh& mesh);

}  // namespace nearfield::geometry
