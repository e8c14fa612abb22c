#pragma once

#include <engine/geometry/float_arrays.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

/// \file
/// The inner loops of distance fields, compiled for several instruction sets of which the best that
/// the machine has is chosen at run time. In single precision, relative to a place nearby.

namespace nearfield::exact {

/// Edges that may be near.
class EdgeList : public geometry::FloatArrays<6> {
public:
    enum Number : std::uint8_t {
        start_x,
        start_y,
        along_x,  ///< from the start to the end
        along_y,
        inverse_x,  ///< the same divided by its squared length; 0 for an edge of no length
        inverse_y,
    };
};

/// A disc around the centres of some cells.
struct Disc {
    float x = 0.0F;
    float y = 0.0F;
    float radius = 0.0F;
};

/// Puts into `to` the edges that can be nearest to a point of the disc, or as near as the nearest
/// up to `slack` and what single precision loses; what was in it is lost. Returns the distance of
/// the nearest from the disc's centre. `squared`: scratch for as many numbers as `from` has room
/// for.
float select_near(const EdgeList& from, const Disc& disc, float slack, std::vector<float>& squared,
                  EdgeList& to);

/// The side of a block of cells that is worked on at once.
inline constexpr std::uint32_t block_side = 8;

/// A block of cells, and where what is found out about them goes.
struct Block {
    float x = 0.0F;  ///< of the centre of its first cell, as the edges have it; cells have side 1
    float y = 0.0F;
    std::uint32_t columns = block_side;  ///< of it that are wanted
    std::uint32_t rows = block_side;
    std::uint64_t inside = 0;          ///< a bit a cell, eight a row
    float scale = 1.0F;                ///< that distances are multiplied by
    float* distances = nullptr;        ///< signed; of the first cell; may be null
    std::uint32_t* nearest = nullptr;  ///< words as below; may be null
    std::size_t stride = 0;            ///< from row to row of both
    float margin = 0.0F;               ///< two distances closer than this count as equal
};

/// The word of a cell: its nearest edge and two flags.
inline constexpr std::uint32_t nearest_inside = 1U << 31U;
inline constexpr std::uint32_t nearest_unique = 1U << 30U;

/// What solve_block() works on, kept from block to block.
struct BlockScratch {
    geometry::FloatArrays<3> runs;  ///< of edges: x and y of a vertex, and how far the others are
    EdgeList near;                  ///< to some cells
};

/// Distances and nearest edges at the cells of a block, among the edges given. Returns the largest
/// distance, 0 where none is asked for.
float solve_block(const EdgeList& edges, const Block& block, BlockScratch& scratch);

}  // namespace nearfield::exact
