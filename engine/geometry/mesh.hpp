#pragma once

#include <engine/geometry/whole.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::geometry {

/// What the rasteriser is fed, always as lists of triangles.
///
/// Positions are in cells of a tile: (0, 0) is the low corner of the tile, the centre of cell
/// (c, r) is (c + 1/2, r + 1/2).
struct MeshVertex {
    float x = 0.0F;
    float y = 0.0F;
    float distance = 0.0F;  ///< in cells; only the distance mesh uses it
    std::uint32_t id = 0;   ///< the same at all three vertices of a triangle
};

using Mesh = std::vector<MeshVertex>;

/// The raster's sub-pixel grid: a rasteriser rounds vertex positions to multiples of 1/steps of a
/// pixel. Positions rounded here first are taken by every rasteriser as they are, so all of them
/// (and a scanline on the CPU) agree on every sample.
struct SubpixelGrid {
    double steps = 256.0;  ///< 2^VkPhysicalDeviceLimits::subPixelPrecisionBits

    /// The nearest position on the grid; halves go up.
    [[nodiscard]] double snap(double coordinate) const {
        return whole_below(coordinate * steps + 0.5) / steps;
    }
    /// No point moves farther than this when both its coordinates are snapped, in cells.
    [[nodiscard]] double largest_move() const;
};

}  // namespace nearfield::geometry
