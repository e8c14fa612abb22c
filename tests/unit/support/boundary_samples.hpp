#pragma once

#include <engine/queries/boundary_points.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <vector>

namespace nearfield::samples {

/// All samples of a polygon's boundary, ring by ring, as in every technique.
inline std::vector<queries::BoundaryPoint> of_boundary(const simd::TransformedEdges& edges,
                                                       double spacing) {
    const geometry::Polygon& polygon = edges.placed.polygon();
    std::vector<geometry::Chain> rings;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t begin = polygon.ring_begin(ring);
        rings.push_back({ring, begin, polygon.ring_end(ring) - begin, {}});
    }
    std::vector<queries::BoundaryPoint> points;
    queries::sample_chains(edges.placed, rings, spacing, edges.box, points);
    return points;
}

}  // namespace nearfield::samples
