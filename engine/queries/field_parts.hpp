#pragma once

#include <nearfield/query.hpp>

#include <cstdint>

namespace nearfield::queries {

/// The outputs that the device computes and returns for a distance field, derived from its query.
struct FieldParts {
    bool values = false;         ///< a signed distance at every cell
    bool features = false;       ///< the nearest feature at every cell
    bool host_values = false;    ///< the values are read back
    bool host_features = false;  ///< the features are read back
    bool blended = false;        ///< the image of blended gradients is drawn; needs the values
    bool gradients = false;      ///< and read back whole
    /// Cells whose values are read back with each point: the four around it and, for central
    /// differences, the eight around those.
    std::uint32_t cells_per_point = 4;
    /// 32-bit words per point: its feature, the values and, where they are blended, the gradients.
    std::uint32_t words_per_point = 5;
    /// Cells drawn around the grid, and around each of its tiles, for reconstruction and
    /// differences.
    std::uint32_t halo = 0;
    /// Use small tiles: each cell searches the edges of its tile, or only few tiles hold points.
    /// Independent of the other outputs, so that the image and the cells alone agree bit for bit.
    bool small_tiles = false;
};

[[nodiscard]] FieldParts field_parts(const DistanceFieldQuery& query);

}  // namespace nearfield::queries
