#pragma once

#include <engine/exact/placed_edges.hpp>
#include <engine/plan/boundary_points.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield {

/// The samples of a small polygon's boundary in a box, an array for each coordinate. Keeps
/// its memory from polygon to polygon.
class EdgeSamples {
public:
    /// In order along the rings. Valid until the next call.
    [[nodiscard]] exact::PointArrays sample(const exact::PlacedEdges& edges,
                                            const geometry::Box& within, double spacing);

private:
    std::array<std::uint32_t, exact::padded(exact::most_edges_one_by_one)> near_;
    std::vector<plan::BoundaryPoint> places_;
    std::vector<double> x_;
    std::vector<double> y_;
};

}  // namespace nearfield
