// What the export passes read from the tables and keep between their steps (resident outputs), for
// shaders and for C++ (see shared.h).
#ifndef NEARFIELD_SHADERS_EXPORT_H
#define NEARFIELD_SHADERS_EXPORT_H

#include "layout.h"

NEARFIELD_SHARED_BEGIN

// The steps of the passes that write packed records or samples. The first is that of samples only.
const uint box_step = 0u;
const uint count_step = 1u;
const uint place_step = 2u;
const uint write_step = 3u;

// Points whose records one thread counts, one after the other. Fewer blocks than drivers allow
// turns of a loop (see max_instance_steps) hold all that a search looks at.
const uint points_per_block = 64u;

// What there is of such a block.
struct RecordBlockData {
    // Records; after the second step, records of the blocks before it
    uint count NEARFIELD_DEFAULT(0);
    uint deepest NEARFIELD_DEFAULT(0);    // index among them
    float depth NEARFIELD_DEFAULT(0.0F);  // in units of B's frame
    uint unused NEARFIELD_DEFAULT(0);
};
NEARFIELD_CHECK(sizeof(RecordBlockData) == 16)

// Of an output's header, before what the passes keep.
const uint bytes_of_header = 80u;

// Replaces the word of something that does not exist.
const uint no_word = 0xffffffffu;

// A tile of an intersection, as stored in the tables. The masks of its shapes lie in the scratch
// memory of its tile batch.
struct SampleTileData {
    uint width NEARFIELD_DEFAULT(0);
    uint height NEARFIELD_DEFAULT(0);
    // Each row of cells is one of the query's blocks, starting at the lowest row; `block_step`
    // blocks lie between one row and the next, for the rows of the tiles beside it.
    uint first_block NEARFIELD_DEFAULT(0);
    uint block_step NEARFIELD_DEFAULT(0);
    uint mask_a NEARFIELD_DEFAULT(0);  // first words
    uint mask_b NEARFIELD_DEFAULT(0);
    // Word of the first cell's edge of A; no_word where A takes part by its volume
    uint edges NEARFIELD_DEFAULT(no_word);
    uint summary NEARFIELD_DEFAULT(0);  // index among the summaries of its tile batch
    uint region NEARFIELD_DEFAULT(0);
    // Low corner of the tile, relative to the query's origin
    float corner_x NEARFIELD_DEFAULT(0.0F);
    float corner_y NEARFIELD_DEFAULT(0.0F);
};
const uint words_of_tile = 11u;
NEARFIELD_CHECK(sizeof(SampleTileData) == 4 * words_of_tile)

// The number of a tile's samples, and the low and high corner of their box. They come before the
// counts of all rows.
const uint words_of_box = 5u;

NEARFIELD_SHARED_END

#endif
