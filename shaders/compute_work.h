// The work of a tile batch of the compute technique, beyond edge lists, points and fields, for
// shaders and for C++ (see shared.h).
//
// A mask has one bit per cell, in rows of whole words. Masks and other device-only data lie in the
// device's scratch memory, at the word given.
#ifndef NEARFIELD_SHADERS_COMPUTE_WORK_H
#define NEARFIELD_SHADERS_COMPUTE_WORK_H

#include "shared.h"

NEARFIELD_SHARED_BEGIN

// Side of a block of a field tile, in cells; blocks at the tile's high borders may be smaller. At
// most half a mask word, so that a row of a block lies in one word.
const uint block_side = 16u;
const uint columns_per_thread = 2u;
const uint threads_per_block = block_side / columns_per_thread;

// A shape as a tile sees it. Numbers in two parts are sums of two floats.
struct ShapeInTileData {
    // From the shape's frame to cells relative to the tile's low corner: the x axis, of a unit of
    // the frame, and the shape's centre.
    vec2 axis;
    vec2 axis_low;
    vec2 offset;
    vec2 offset_low;
    uint shape NEARFIELD_DEFAULT(0);  // its first unit in the input
    uint size NEARFIELD_DEFAULT(0);   // of the tile: width | height << 16
    uint mask NEARFIELD_DEFAULT(0);   // first word of its mask in the scratch memory
    // In single precision two distances in the tile may be off by less than this together, in
    // cells, beside a part of the distance itself
    float slack NEARFIELD_DEFAULT(0.0F);
};
const uint units_of_shape_in_tile = 3u;
NEARFIELD_CHECK(sizeof(ShapeInTileData) == 16 * units_of_shape_in_tile)

// A shape whose volume or boundary is put into a mask.
struct MaskShapeData {
    ShapeInTileData placed;
    uint first_thread NEARFIELD_DEFAULT(0);  // among those of all shapes in masks
    // Of a boundary: how far from it a cell's centre may be, in cells. Negative: the volume
    float reach NEARFIELD_DEFAULT(-1.0F);
    // Where the lowest edges within reach of the cells start, among those of all tiles, one word
    // per cell; no_edges if they are not requested.
    uint first_edge NEARFIELD_DEFAULT(0);
    // A thread has 1 << shift places for edges (search.h): a box of some level of them, or, if it
    // is less than box_shift, a part of a chunk.
    uint shift NEARFIELD_DEFAULT(0);
};
const uint units_of_mask_shape = units_of_shape_in_tile + 1u;
NEARFIELD_CHECK(sizeof(MaskShapeData) == 16 * units_of_mask_shape)
const uint no_edges = 0xffffffffu;
const uint box_shift = 3u;  // of the eight places of a chunk, and of the eight boxes of a box

// An overlap tile.
struct OverlapData {
    uint mask_a NEARFIELD_DEFAULT(0);  // first words in the scratch memory
    uint mask_b NEARFIELD_DEFAULT(0);
    uint size NEARFIELD_DEFAULT(0);        // width | height << 16
    uint first_row NEARFIELD_DEFAULT(0);   // among the rows of all overlap tiles
    uint first_edge NEARFIELD_DEFAULT(0);  // of the cells of A's boundary, as MaskShapeData's
    uint tile NEARFIELD_DEFAULT(0);        // in TileBatch::tiles
    uint flags NEARFIELD_DEFAULT(0);
    uint unused NEARFIELD_DEFAULT(0);
};
const uint units_of_overlap = 2u;
NEARFIELD_CHECK(sizeof(OverlapData) == 16 * units_of_overlap)
const uint overlap_lists = 1u;     // samples are listed, not only counted
const uint overlap_volume_a = 2u;  // A takes part by its volume
const uint overlap_volume_b = 4u;

NEARFIELD_SHARED_END

#endif
