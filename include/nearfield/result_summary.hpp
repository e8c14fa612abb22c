#pragma once

#include <nearfield/localization.hpp>
#include <nearfield/query.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <vector>

/// \file
/// The members that the results of all queries have.

namespace nearfield {

/// A rectangle found by localisation, with the grid on which it was sampled. Sample (column, row)
/// is the centre of its cell: min + (column + 1/2, row + 1/2) * cell; row 0 is the lowest.
struct Region {
    Vector2 min;               ///< low corner, also of cell (0, 0)
    Vector2 max;               ///< high corner
    std::uint32_t width = 0;   ///< cells along x
    std::uint32_t height = 0;  ///< cells along y
};

/// The members that all results have.
struct ResultSummary {
    Status status;             ///< of this query alone; if it is an error, ignore the rest
    double tolerance = 0.0;    ///< d of the query
    double error_bound = 0.0;  ///< at most d; the type of the result states what it bounds
    /// The closed shapes share a point; containment and touching count. This holds for the rings as
    /// given: for shapes with a deviation the opposite can be true if they are no farther apart, or
    /// no deeper in each other, than the sum of their deviations. False for a distance field
    /// without a shape A.
    bool intersects = false;
    double cell = 0.0;            ///< side of a grid cell; maximum gap between boundary samples
    std::vector<Region> regions;  ///< the regions sampled; for exceptions see Technique::cpu
    LocalizationStatistics localization;      ///< work of the search for regions
    Technique technique = Technique::raster;  ///< the technique that answered; never automatic
};

/// The type of the points of results that list none.
struct NoPoint {};

/// A part of a boundary: an edge without its end points, or a vertex. Indices count through all
/// rings of the shape in the order given.
struct Feature {
    /// The kinds of features.
    enum class Kind : std::uint8_t {
        edge,    ///< from vertex `index` to the next one of its ring
        vertex,  ///< vertex `index`
    };
    Kind kind = Kind::edge;   ///< edge or vertex
    std::uint32_t index = 0;  ///< among all edges, or all vertices, of the shape
};

}  // namespace nearfield
