#pragma once

#include <engine/geometry/segment.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/queries/grid.hpp>
#include <nearfield/result.hpp>

#include <shaders/layout.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

/// Derives features, in double precision, from the edge that the device found nearest.
namespace nearfield::solvers {

/// The device decides on which side of the boundary a point lies in single precision, in cells of a
/// tile. Closer to the boundary than this distance, the side is undecided: the point touches. In
/// larger tiles than those of points, coordinates are rounded more.
[[nodiscard]] inline double touching_distance(double cell, std::uint32_t tile_side) {
    constexpr std::uint32_t side_of_points = 64;
    constexpr double touching = double{shaders::touching} / side_of_points;
    return cell * (std::max(tile_side, side_of_points) * touching);
}
[[nodiscard]] inline double touching_distance(const queries::Tile& tile) {
    return touching_distance(tile.grid.cell, std::max(tile.width, tile.height));
}

/// The point of an edge nearest to a point.
[[nodiscard]] inline geometry::NearestOnSegment nearest_on_edge(
    const geometry::TransformedPolygon& polygon, std::uint32_t edge,
    const geometry::Vector& point) {
    return geometry::nearest_on_segment(point, polygon.vertex(edge),
                                        polygon.vertex(polygon.polygon().next(edge)));
}

/// The feature of the boundary at a parameter of an edge.
[[nodiscard]] inline Feature feature_at(const geometry::TransformedPolygon& polygon,
                                        std::uint32_t edge, double parameter) {
    if (parameter <= 0.0) {
        return {Feature::Kind::vertex, edge};
    }
    if (parameter >= 1.0) {
        return {Feature::Kind::vertex, polygon.polygon().next(edge)};
    }
    return {Feature::Kind::edge, edge};
}

}  // namespace nearfield::solvers
