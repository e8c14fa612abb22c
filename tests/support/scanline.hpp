#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/vector.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace nearfield::support {

using Rings = std::vector<std::vector<geometry::Vector>>;

/// The samples of a tile: pixel centres (column + 1/2, row + 1/2), row 0 at the lowest y, which is
/// the top of a framebuffer.
struct Tile {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    geometry::SubpixelGrid grid = {};

    [[nodiscard]] std::size_t index(std::uint32_t column, std::uint32_t row) const {
        return std::size_t{row} * width + column;
    }
    [[nodiscard]] static geometry::Vector centre(std::uint32_t column, std::uint32_t row) {
        return {column + 0.5, row + 0.5};
    }
};

/// A sample that a triangle covers: its index in the tile and the weights of the triangle's corners
/// there, which sum to 1.
using Fragment = std::function<void(std::size_t index, const std::array<double, 3>& weights)>;

/// Visits every sample that the triangle covers, as a rasteriser does: positions are rounded to the
/// tile's sub-pixel grid, coverage is exact in integers, and a sample on an edge belongs to the
/// triangle if the edge is a left or a top edge (the top-left rule). Either winding.
void rasterise(const Tile& tile, std::span<const geometry::MeshVertex, 3> triangle,
               const Fragment& visit);

/// Draws the mesh with stencil INVERT: 1 where an odd number of its triangles cover the sample.
[[nodiscard]] std::vector<std::uint8_t> draw_parity(const Tile& tile, const geometry::Mesh& mesh);

/// The result at a sample after drawing with the depth test LESS.
struct Nearest {
    float distance = std::numeric_limits<float>::infinity();  ///< infinity: not covered
    std::uint32_t id = 0xFFFFFFFFU;                           ///< as above: all ones
};

/// Draws the mesh with its distance as depth.
[[nodiscard]] std::vector<Nearest> draw_nearest(const Tile& tile, const geometry::Mesh& mesh);

/// 1 at the samples inside the rings by the odd-even rule, after their vertices are snapped to the
/// tile's grid; exact in integers. A sample crosses an edge that spans its y, lower end included
/// and upper end excluded, and passes strictly on the side of larger x, in agreement with the
/// top-left rule for samples on an edge. For coordinates up to 10^6.
[[nodiscard]] std::vector<std::uint8_t> scan_parity(const Tile& tile, const Rings& rings);

}  // namespace nearfield::support
