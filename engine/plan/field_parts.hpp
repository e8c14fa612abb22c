#pragma once

#include <nearfield/query.hpp>

#include <cstdint>

namespace nearfield::plan {

/// What the device computes and hands back for a distance field, as follows from its query.
struct FieldParts {
    bool values = false;         ///< a signed distance at every cell
    bool features = false;       ///< the nearest feature at every cell
    bool host_values = false;    ///< the values are handed back
    bool host_features = false;  ///< the features are
    bool blended = false;        ///< the image of blended gradients is drawn; needs the values
    bool gradients = false;      ///< and handed back whole
    /// Cells whose values are handed back with each point: the four around, and for central
    /// differences the eight around those.
    std::uint32_t cells_per_point = 4;
    /// 32-bit words of a point: its feature, the values, and the gradients where they are blended.
    std::uint32_t words_per_point = 5;
    /// Cells drawn around the grid, and around each of its tiles, because reconstruction and
    /// differences look beyond.
    std::uint32_t halo = 0;
    /// Each cell looks through the edges of its tile, or few tiles may hold any point. Whatever
    /// else is asked for, so that the image and the cells alone agree bit for bit.
    bool small_tiles = false;
};

[[nodiscard]] FieldParts field_parts(const DistanceFieldQuery& query);

}  // namespace nearfield::plan
