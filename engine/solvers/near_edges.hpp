#pragma once

#include <engine/geometry/edge_list_kernels.hpp>
#include <engine/geometry/float_arrays.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

/// \file
/// The inner loops of distance fields, compiled for several instruction sets; the best one that the
/// machine supports is selected at run time. In single precision, relative to a nearby origin.

namespace nearfield::solvers {

using geometry::EdgeList;

/// A disc around the centres of some cells.
struct Disc {
    float x = 0.0F;
    float y = 0.0F;
    float radius = 0.0F;
};

/// Replaces `to` by the edges that can be nearest to a point of the disc, or as near as the nearest
/// up to `slack` and single-precision rounding. Returns the distance of the nearest edge from the
/// disc's centre. `squared`: scratch with the capacity of `from`.
float select_near(const EdgeList& from, const Disc& disc, float slack, std::vector<float>& squared,
                  EdgeList& to);

/// The side of a block of cells that is processed together.
inline constexpr std::uint32_t block_side = 8;

/// A block of cells, and where its results are written.
struct Block {
    float x = 0.0F;  ///< centre of the first cell, in the edges' coordinates; cells have side 1
    float y = 0.0F;
    std::uint32_t columns = block_side;  ///< number of columns requested
    std::uint32_t rows = block_side;
    std::uint64_t inside = 0;          ///< one bit per cell, eight per row
    float scale = 1.0F;                ///< factor applied to distances
    float* distances = nullptr;        ///< signed; at the first cell; may be null
    std::uint32_t* nearest = nullptr;  ///< words as below; may be null
    std::size_t stride = 0;            ///< row stride of both
    float margin = 0.0F;               ///< two distances closer than this count as equal
};

/// The word of a cell: its nearest edge and two flags.
inline constexpr std::uint32_t nearest_inside = 1U << 31U;
inline constexpr std::uint32_t nearest_unique = 1U << 30U;

/// Working memory of solve_block(), reused between blocks.
struct BlockScratch {
    geometry::FloatArrays<3> runs;  ///< of edges: x and y of a vertex, distance of the others
    EdgeList near;                  ///< edges near some cells
};

/// Computes distances and nearest edges at the cells of a block, among the given edges. Returns the
/// largest distance, or 0 if no distances are requested.
float solve_block(const EdgeList& edges, const Block& block, BlockScratch& scratch);

}  // namespace nearfield::solvers
