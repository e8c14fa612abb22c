#pragma once

#include <engine/geometry/whole.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::geometry {

/// The rasteriser's input, always a list of triangles.
///
/// Positions are in cells of a tile: (0, 0) is the tile's low corner, and (c + 1/2, r + 1/2) is the
/// centre of cell (c, r).
struct MeshVertex {
    float x = 0.0F;
    float y = 0.0F;
    float distance = 0.0F;  ///< in cells; used by the distance mesh only
    std::uint32_t id = 0;   ///< the same at all three vertices of a triangle
};

using Mesh = std::vector<MeshVertex>;

/// The rasteriser's sub-pixel grid. A rasteriser rounds vertex positions to multiples of 1/steps of
/// a pixel. Positions rounded here first pass through every rasteriser unchanged, so all of them
/// (and a scanline on the CPU) agree on every sample.
struct SubpixelGrid {
    double steps = 256.0;  ///< 2^VkPhysicalDeviceLimits::subPixelPrecisionBits

    /// Returns the nearest position on the grid; halves round up.
    [[nodiscard]] double snap(double coordinate) const {
        return whole_below(coordinate * steps + 0.5) / steps;
    }
    /// The farthest a point can move when both its coordinates are snapped, in cells.
    [[nodiscard]] double largest_move() const;
};

/// The grid of Technique::cpu, on every machine: that of most devices.
inline constexpr SubpixelGrid cpu_grid{256.0};

}  // namespace nearfield::geometry
