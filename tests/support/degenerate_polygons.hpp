#pragma once

#include <tests/support/scanline.hpp>

#include <string>
#include <vector>

namespace nearfield::support {

struct DegeneratePolygon {
    std::string name;  ///< kind, tile and seed: enough to reproduce it
    Rings rings;
};

/// Degenerate polygons, in cells of a tile of width x height: one of each kind per seed
/// (self-crossing, stars, combs, slivers, spikes, duplicate vertices, collinear runs, vertices on
/// pixel centres, holes, tiny, around the tile, beside it, islands in any order).
[[nodiscard]] std::vector<DegeneratePolygon> degenerate_polygons(std::uint32_t width,
                                                                 std::uint32_t height,
                                                                 std::uint32_t seed);

/// As above, with vertices up to 10^6 cells away.
[[nodiscard]] std::vector<DegeneratePolygon> huge_polygons(std::uint32_t width,
                                                           std::uint32_t height,
                                                           std::uint32_t seed);

/// The distance from p to the segment ab.
[[nodiscard]] double distance_to_segment(const geometry::Vector& p, const geometry::Vector& a,
                                         const geometry::Vector& b);

}  // namespace nearfield::support
