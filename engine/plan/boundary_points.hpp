#pragma once

#include <engine/geometry/placed_polygon.hpp>
#include <engine/localize/overlap.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::plan {

/// A point on the boundary of A: on edge `edge`, `parameter` of the way along it.
struct BoundaryPoint {
    std::uint32_t edge = 0;
    double parameter = 0.0;  ///< 0: the edge's first vertex; below 1
};

/// The point in world coordinates.
[[nodiscard]] geometry::Vector position(const geometry::PlacedPolygon& polygon,
                                        const BoundaryPoint& point);

/// Appends samples along each chain, consecutive ones at most `spacing` apart along the boundary,
/// where it lies `within` a box; what samples there are outside it is left open. Long edges are
/// divided evenly from vertex to vertex, so corners are sampled; of vertices closer together than
/// `spacing` some are left out: of each run of 64 edges of a ring, counted from its first vertex,
/// the first vertex is sampled. Where the samples of an edge are depends on the polygon and the
/// spacing alone, so the last one before a chain may lie outside it.
void sample_chains(const geometry::PlacedPolygon& polygon,
                   const std::vector<localize::Chain>& chains, double spacing,
                   const geometry::Box& within, std::vector<BoundaryPoint>& points);

/// Appends the first vertex of every edge of the chains.
void vertices_of_chains(const geometry::PlacedPolygon& polygon,
                        const std::vector<localize::Chain>& chains,
                        std::vector<BoundaryPoint>& points);

/// What that may append at the most.
[[nodiscard]] double most_vertices(const std::vector<localize::Chain>& chains);

/// What sample_chains may append at the most; needs no memory. A double, since it may be huge.
[[nodiscard]] double most_samples(const geometry::PlacedPolygon& polygon,
                                  const std::vector<localize::Chain>& chains, double spacing,
                                  const geometry::Box& within);

/// The same of the whole boundary, roughly: at most half as many again, and a few more.
[[nodiscard]] double most_samples(const geometry::Polygon& polygon, double spacing);

}  // namespace nearfield::plan
