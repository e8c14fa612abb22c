// The work of a tile batch of the compute technique, beyond edge lists and points, for shaders and
// for C++ (see shared.h). Coordinates are in sub-pixel steps from the tile's low corner: the same
// snapped vertices that the raster technique would draw.
//
// A mask has one bit per cell, in rows of whole words. Masks and other device-only data lie in the
// device's scratch memory, at the word given. The elements of one kind lie one after the other in
// an array of words; shaders read the words that they need.
#ifndef NEARFIELD_SHADERS_COMPUTE_WORK_H
#define NEARFIELD_SHADERS_COMPUTE_WORK_H

#include "shared.h"

NEARFIELD_SHARED_BEGIN

// Side of a block of a field tile, in cells; blocks at the tile's high borders may be smaller. At
// most half a mask word, so that a row of a block lies in one word.
const uint block_side = 16u;
const uint columns_per_thread = 2u;
const uint threads_per_block = block_side / columns_per_thread;

// Position and size of a mask.
struct MaskData {
    uint first_word NEARFIELD_DEFAULT(0);
    uint words_per_row NEARFIELD_DEFAULT(0);
    uint width NEARFIELD_DEFAULT(0);
    uint height NEARFIELD_DEFAULT(0);
};
const uint words_of_mask = 4u;
NEARFIELD_CHECK(sizeof(MaskData) == 4 * words_of_mask)

// An edge that inverts the samples to its left (geometry::FillMesh::Piece).
struct MaskEdgeData {
    int x0 NEARFIELD_DEFAULT(0);
    int y0 NEARFIELD_DEFAULT(0);
    int x1 NEARFIELD_DEFAULT(0);
    int y1 NEARFIELD_DEFAULT(0);
    uint mask NEARFIELD_DEFAULT(0);  // in ComputeWork::masks
};
const uint words_of_mask_edge = 5u;
NEARFIELD_CHECK(sizeof(MaskEdgeData) == 4 * words_of_mask_edge)

// A row of a mask in which edges have inverted samples.
struct MaskRowData {
    uint first_word NEARFIELD_DEFAULT(0);
    uint words NEARFIELD_DEFAULT(0);
};
const uint words_of_mask_row = 2u;
NEARFIELD_CHECK(sizeof(MaskRowData) == 4 * words_of_mask_row)

// An offset polygon: a triangle fan around its first corner.
const uint corners_of_polygon = 8u;
struct MaskPolygonData {
    int corners[2u * corners_of_polygon] NEARFIELD_DEFAULT({});  // x, y of each
    uint overlap NEARFIELD_DEFAULT(0);                           // in ComputeWork::overlaps
    uint run NEARFIELD_DEFAULT(0);                               // of A's edges, in TileBatch::runs
};
const uint overlap_of_polygon = 2u * corners_of_polygon;  // word
const uint run_of_polygon = overlap_of_polygon + 1u;
const uint words_of_polygon = run_of_polygon + 1u;
NEARFIELD_CHECK(sizeof(MaskPolygonData) == 4 * words_of_polygon &&
                offsetof(MaskPolygonData, overlap) == 4 * overlap_of_polygon &&
                offsetof(MaskPolygonData, run) == 4 * run_of_polygon)
// With the number of sub-pixel bits of a dispatch: its polygons are A's.
const uint polygons_of_a = 256u;

// An overlap tile.
struct OverlapData {
    uint mask_a NEARFIELD_DEFAULT(0);  // in ComputeWork::masks
    uint mask_b NEARFIELD_DEFAULT(0);
    // Where the runs of the cells of A's boundary start in the scratch memory, one word per cell;
    // no_runs if they are not requested.
    uint first_run NEARFIELD_DEFAULT(0);
    uint tile NEARFIELD_DEFAULT(0);  // in TileBatch::tiles
    uint list NEARFIELD_DEFAULT(0);  // 1: samples are listed; 0: only counted
};
const uint words_of_overlap = 5u;
NEARFIELD_CHECK(sizeof(OverlapData) == 4 * words_of_overlap)
const uint no_runs = 0xffffffffu;

// A row of an overlap tile.
struct OverlapRowData {
    uint overlap NEARFIELD_DEFAULT(0);
    uint row NEARFIELD_DEFAULT(0);
};
const uint words_of_overlap_row = 2u;
NEARFIELD_CHECK(sizeof(OverlapRowData) == 4 * words_of_overlap_row)

NEARFIELD_SHARED_END

#endif
