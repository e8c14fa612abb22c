#pragma once

#include <engine/base/shape_errors.hpp>
#include <engine/geometry/mesh.hpp>
#include <engine/queries/technique.hpp>
#include <nearfield/localization.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::queries {

/// Minimum side of an atlas image of drawn tiles, in cells, without its last gap.
inline constexpr std::uint32_t smallest_atlas = 256;
/// The same of the largest. Twice as many cells fit into a viewport of any device.
inline constexpr std::uint32_t largest_atlas_side = 2048;

/// Limits set by the device and the caller.
struct QueryLimits {
    const ShapeErrors* shape_errors = nullptr;  ///< of the context; for handles without a shape
    geometry::SubpixelGrid subpixel;            ///< of the device
    std::uint32_t largest_tile = 1024;          ///< cells along a side
    /// Side, in cells, of tiles for boundary points. Points are sparse in their region: small tiles
    /// omit the empty parts, and each draws and tests only the edges near it.
    std::uint32_t points_tile = 64;
    /// The same for field tiles with features, where each cell searches all edges that can be
    /// nearest in its tile, or with points, which few tiles may hold.
    std::uint32_t features_tile = 64;
    std::uint32_t largest_atlas = largest_atlas_side;
    std::uint32_t largest_image = 4096;  ///< pixels along a side of a resident image
    std::uint64_t largest_range = std::uint64_t{1} << 27U;  ///< bytes that a shader can address
    std::uint64_t offset_alignment = 1;                     ///< of what it addresses, in bytes
    std::uint64_t memory = 0;                               ///< bytes a batch may need
    std::uint32_t hierarchy_height = 12;
    BoundingVolume bounding_volume = BoundingVolume::axis_aligned;
    /// By strategy: the requirements that the device lacks.
    std::array<std::vector<std::string>, intersection_strategies> missing_for_strategy;
    AvailableTechniques techniques;
};

}  // namespace nearfield::queries
