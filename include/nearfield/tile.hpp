#pragma once

#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <cstdint>

/// \file
/// How a batch was divided into tiles for the device: a report for visualisation and tuning
/// (list_tiles() of diagnostics.hpp).

namespace nearfield {

/// A tile: a rectangle of cells of a query's grid that the device processes as a unit, part of one
/// of the query's regions. Technique::raster packs the tiles of all queries of a batch into an
/// atlas image, four cells apart; tiles that do not fit go into further tile batches. Tiles of
/// Technique::compute have no position in an atlas. Technique::cpu has no tiles.
struct TileReport {
    std::uint32_t query = 0;                  ///< position of its query in the batch
    Technique technique = Technique::raster;  ///< raster or compute
    /// The shape whose boundary points the tile is for. Contacts and separations, which use the
    /// points of both shapes, have tiles of either side; all other tiles are Side::a.
    Side side = Side::a;
    Vector2 min;  ///< low corner, world coordinates; includes a border around the region
    Vector2 max;  ///< high corner, world coordinates; includes a border around the region
    std::uint32_t width = 0;   ///< cells along x
    std::uint32_t height = 0;  ///< cells along y
    /// Number of its tile batch: one filling of the atlas, or one dispatch of the compute
    /// technique. Numbered from 0 within a batch, those of the raster first.
    std::uint32_t tile_batch = 0;
    /// First column of the tile in the atlas image, in which a cell is a pixel; 0 for compute.
    std::uint32_t x = 0;
    std::uint32_t y = 0;  ///< first row of the tile in the atlas image; 0 for compute
};

}  // namespace nearfield
