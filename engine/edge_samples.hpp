#pragma once

#include <engine/exact/placed_edges.hpp>
#include <engine/plan/boundary_points.hpp>

#include <cstdint>
#include <vector>

namespace nearfield {

/// The samples of a polygon's boundary in a box, an array for each coordinate. Keeps
/// its memory from polygon to polygon.
class EdgeSamples {
public:
    /// In order along the rings. Valid until the next call.
    [[nodiscard]] exact::PointArrays sample(const exact::PlacedEdges& edges,
                                            const geometry::Box& within, double spacing);

private:
    std::vector<std::uint32_t> near_;  // edges
    std::vector<plan::BoundaryPoint> places_;
    std::vector<double> x_;
    std::vector<double> y_;
};

}  // namespace nearfield
