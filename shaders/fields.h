// Distance fields of the compute technique, whose lists of near edges the device makes, for shaders
// and for C++ (see shared.h).
//
// A field tile is cut into regions of 4 x 4 blocks, these into quarters of 2 x 2 blocks. Each
// region lists the chunks of B's edges (search.h) that can be nearest somewhere in it, each quarter
// the edges of these chunks that can, each block the segments of these edges. What does not fit
// makes the blocks below crowded: their cells search B's hierarchy one by one.
#ifndef NEARFIELD_SHADERS_FIELDS_H
#define NEARFIELD_SHADERS_FIELDS_H

#include "compute_work.h"
#include "search.h"

NEARFIELD_SHARED_BEGIN

const uint quarter_side = 2u * block_side;  // in cells
const uint region_side = 2u * quarter_side;

// The lists in the scratch memory. The first word of a list is the number of its elements. A
// workgroup that makes the lists of a quarter and its blocks keeps the quarter's in shared memory.
const uint words_of_region = 512u;
const uint words_of_quarter = 512u;
// All blocks share the room for segments, a unit each: the middle of an edge's part near the block,
// relative to the block's low corner, and the way from there to the end of the part. For each block
// two words tell which is its first segment and how many there are.
const uint crowded = 0xffffffffu;  // in place of a number: there was no room

// A field tile.
struct FieldTileData {
    ShapeInTileData b;
    // Numbers of the first of its regions, quarters and blocks, among those of all tiles
    uint first_region NEARFIELD_DEFAULT(0);
    uint first_quarter NEARFIELD_DEFAULT(0);
    uint first_block NEARFIELD_DEFAULT(0);
    // Where its values and features start in the field's results, or not_asked
    uint first_value NEARFIELD_DEFAULT(not_asked);
    uint first_feature NEARFIELD_DEFAULT(not_asked);
    float margin NEARFIELD_DEFAULT(0.0F);  // two distances that differ by less count as equal
    // Of its rows of cells, among those of all tiles
    uint first_row NEARFIELD_DEFAULT(0);
    uint unused[1] NEARFIELD_DEFAULT({});
};
const uint units_of_field_tile = 5u;
NEARFIELD_CHECK(sizeof(FieldTileData) == 16 * units_of_field_tile)

// Turns of the loops of one walk over B's boxes. Some drivers end the loops of an invocation
// without notice after 65,535 turns, and there are up to three walks. A walk takes a turn for each
// edge, chunk and group that it visits: around a shape of at most max_certain_edges, whatever its
// rings, it always comes to its end.
const uint max_walk_turns = 20000u;
const uint max_certain_edges = 12000u;

// The cells of crowded blocks are searched by an indirect dispatch, whose arguments count the
// blocks: in each a workgroup for a part of the cells.
const uint groups_per_block = block_side * block_side / group_size;

NEARFIELD_SHARED_END

#endif
