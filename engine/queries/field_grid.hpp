#pragma once

#include <engine/queries/checked_query.hpp>
#include <engine/queries/field_parts.hpp>
#include <engine/queries/grid.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <optional>
#include <vector>

/// What all techniques share of a distance field: its grid, its memory, where its points lie, and
/// its bounds.
namespace nearfield::queries {

/// A point at which a field is reconstructed, between four cells of a tile.
struct PlacedFieldPoint {
    geometry::Vector position;  ///< in the world
    std::uint32_t tile = 0;
    std::uint32_t column = 0;  ///< of the low one of the four cells, in the tile, or grid, as drawn
    std::uint32_t row = 0;
    double across = 0.0;  ///< fraction from the centre of that cell to the next, along x
    double up = 0.0;      ///< and along y
};

/// Returns the grid of a field, and states its region in the result; nothing if the query has no
/// area, or a tolerance too small for its coordinates, and then the result states the error.
[[nodiscard]] std::optional<Grid> grid_of_field(const CheckedQuery& query,
                                                DistanceFieldResult& result);

/// Bytes of the requested outputs, in the result, and on the way there in tiles of at most `side`
/// cells drawn with their halos.
[[nodiscard]] double bytes_of_field(const DistanceFieldQuery& query, const FieldParts& parts,
                                    const Grid& grid, double side);

/// Gives the arrays of a result their sizes.
void make_room(const DistanceFieldQuery& query, const Grid& grid, const FieldParts& parts,
               DistanceFieldResult& result);

/// The tiles that a grid is cut into, row by row; the CPU has one of the whole grid.
struct FieldCut {
    std::uint32_t side = UINT32_MAX;  ///< of a tile, in cells, without the halo
    std::uint32_t first_tile = 0;
};
/// Appends the points of a field with their places in the tiles. Returns the error of a point that
/// lies outside the grid; then nothing is appended.
[[nodiscard]] Status place_points(const DistanceFieldQuery& query, const FieldParts& parts,
                                  const Grid& grid, const FieldCut& cut,
                                  std::vector<PlacedFieldPoint>& points);

/// Adds to the bounds of a field what depends on how far it reaches; `largest`: the largest
/// magnitude of a value, in world units. Returns false, empties the field and states the error if
/// single precision does not resolve the tolerance there.
[[nodiscard]] bool state_bounds(const DistanceFieldQuery& query, float largest,
                                DistanceFieldResult& result);

/// Empties a field and states why.
void refuse_field(Status status, DistanceFieldResult& result);

}  // namespace nearfield::queries
