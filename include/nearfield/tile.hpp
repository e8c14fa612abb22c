#pragma once

#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <cstdint>

/// \file
/// How the work of a batch was cut up for the device: told on request, for pictures and tuning.

namespace nearfield {

/// A tile: a rectangle of cells of a query's grid that the device works on as one, part of one of
/// the query's regions. Technique::raster packs the tiles of all queries of a batch into an atlas
/// image, each with its own scissor rectangle; what does not fit goes into further rounds.
/// Technique::compute has tiles without a place. What Technique::cpu answers has none.
struct TileReport {
    std::uint32_t query = 0;                  ///< its query's position in the batch
    Technique technique = Technique::raster;  ///< raster or compute
    /// Whose boundary the points are on that it was made for: of contacts and separations, which
    /// look at the points of both. Side::a of all others.
    Side side = Side::a;
    Vector2 min;              ///< low corner, world coordinates; cells around its region's included
    Vector2 max;              ///< high corner
    std::uint32_t width = 0;  ///< cells along x
    std::uint32_t height = 0;  ///< cells along y
    /// Which filling of the atlas, or which dispatch of the compute technique. Rounds of a batch
    /// are numbered from 0, those of the raster first.
    std::uint32_t round = 0;
    /// Its first column and row in the atlas image, where a cell takes a pixel; 0 for compute.
    std::uint32_t x = 0;
    std::uint32_t y = 0;  ///< see x
};

}  // namespace nearfield
