#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/query/pair.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::test {

/// A sample as a CPU finds it.
struct ReferenceSample {
    Vector2 point;
    /// The edges of A that its own may be: the run whose offset polygon covers the sample first.
    std::uint32_t first_edge = 0;
    std::uint32_t edge_count = 0;  ///< 0 where A takes part by its volume
};

/// What an intersection query has to find, sample by sample in the order of the result: the meshes
/// that the device draws, with their snapped vertices, scanned on the CPU in integers (odd-even for
/// volumes, covered at all for boundaries), and what both cover.
[[nodiscard]] std::vector<ReferenceSample> scan_intersection(const HostDevice& device,
                                                             const PlacedPair& pair,
                                                             IntersectionQuery query,
                                                             const Settings& settings = {});

}  // namespace nearfield::test
