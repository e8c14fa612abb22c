#pragma once

#include <engine/geometry/mesh.hpp>
#include <nearfield/vulkan.hpp>

#include <tests/query/pair.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::test {

/// A sample computed on the CPU.
struct ReferenceSample {
    Vector2 point;
    /// The possible edges of A: the run whose offset polygon covers the sample first.
    std::uint32_t first_edge = 0;
    std::uint32_t edge_count = 0;  ///< < 0 if A takes part by its volume
};

/// The grid to which the raster and compute techniques snap vertices on a device.
[[nodiscard]] geometry::SubpixelGrid grid_of(const HostDevice& device);

/// The expected result of an intersection query, sample by sample in the order of the result: scans
/// the meshes that a device with this grid draws, with their snapped vertices, on the CPU in
/// integers (odd-even for volumes, any coverage for boundaries), and intersects the coverage.
[[nodiscard]] std::vector<ReferenceSample> scan_intersection(geometry::SubpixelGrid grid,
                                                             const PlacedPair& pair,
                                                             IntersectionQuery query,
                                                             const Settings& settings = {});

}  // namespace nearfield::test
