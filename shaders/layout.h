// The structures and constants of the passes over tiles, for shaders and for C++ (see shared.h).
// Lengths are in cells of the tile, positions relative to its low corner.
#ifndef NEARFIELD_SHADERS_LAYOUT_H
#define NEARFIELD_SHADERS_LAYOUT_H

#include "shared.h"

NEARFIELD_SHARED_BEGIN

const uint group_size = 64u;  // threads of a workgroup, where they have one index
// Of a dispatch: what Vulkan guarantees for maxComputeWorkGroupCount
const uint max_workgroups = 65535u;

const uint no_feature = 0xffffffffu;  // in an id image: nothing was drawn
// Where features share their image with signs, the sign is the top bit, ids are below this value,
// and the value itself means that nothing was drawn.
const uint max_signed_features = (1u << 24) - 1u;
const uint feature_bit_mask = 1u << 31;
const uint cluster_size = 8u;  // edges per bounding box

// A list of edges in the geometry array, in clusters: `count` edges (EdgeData) starting at `edges`,
// and, starting at `clusters`, one box (low corner, high corner) for every cluster_size edges. Both
// are even indices of 2-vectors.
struct EdgeListData {
    uint clusters NEARFIELD_DEFAULT(0);
    uint edges NEARFIELD_DEFAULT(0);
    uint count NEARFIELD_DEFAULT(0);
};

// Replaces a position in the results for an output that is not requested.
const uint not_asked = 0xffffffffu;

struct TileData {
    uint atlas_x NEARFIELD_DEFAULT(0);
    uint atlas_y NEARFIELD_DEFAULT(0);
    uint width NEARFIELD_DEFAULT(0);
    uint height NEARFIELD_DEFAULT(0);
    EdgeListData nearest;   // every edge that can be nearest to a needed sample
    EdgeListData crossing;  // every edge that a ray towards +x from inside the tile can cross
    // Farther than this from B's boundary, a sample has its cell's sign
    float settled NEARFIELD_DEFAULT(0.0F);
    float margin NEARFIELD_DEFAULT(0.0F);  // two distances that differ by less count as equal
    uint outside NEARFIELD_DEFAULT(0);     // 1: points outside B are resolved as well
    uint unused[3] NEARFIELD_DEFAULT({});
};
NEARFIELD_CHECK(sizeof(TileData) == 64)

// A rectangle of cells of a drawn tile that one workgroup works on. They follow the tiles in their
// buffer.
struct CellGroup {
    uint tile NEARFIELD_DEFAULT(0);
    uint cell NEARFIELD_DEFAULT(0);  // the low one, column | row << 16
    // Of a field: where the tile's values and features start in the results, or not_asked. Of an
    // overlap: 1 if samples are listed; nothing.
    uint first NEARFIELD_DEFAULT(0);
    uint second NEARFIELD_DEFAULT(0);
};
NEARFIELD_CHECK(sizeof(CellGroup) == 16 && sizeof(TileData) % sizeof(CellGroup) == 0)

// Sides of these rectangles. Of an overlap, a thread works on cells above each other.
const uint field_group_side = 8u;
const uint overlap_group_width = 16u;
const uint overlap_group_height = 32u;
const uint overlap_cells_per_thread = 8u;

// A straight edge: an exact edge, or a simplified edge that represents a run of B's edges.
struct EdgeData {
    vec2 a;
    vec2 b;
    // Where the run's count + 1 vertices start in the geometry array
    uint run NEARFIELD_DEFAULT(0);
    uint run_count NEARFIELD_DEFAULT(1);      // edges in the run; 1: the edge itself
    float deviation NEARFIELD_DEFAULT(0.0F);  // largest distance of the run from the edge
    uint first_edge NEARFIELD_DEFAULT(0);     // index of the run's first edge in B
};
NEARFIELD_CHECK(sizeof(EdgeData) == 32)

// A point whose depth is requested, or at which a field is reconstructed.
struct TilePointData {
    vec2 position;
    uint tile NEARFIELD_DEFAULT(0);
    // Of a field: the low one of the four around, column | row << 16
    uint cell NEARFIELD_DEFAULT(0);
};
NEARFIELD_CHECK(sizeof(TilePointData) == 16)

// A resolved point or cell, one word: B's nearest edge and flags. Zero: outside, not resolved.
const uint point_inside = 1u << 31;
const uint point_unique = 1u << 30;
const uint point_resolved = 1u << 29;
const uint point_doubtful = 1u << 28;  // the CPU has to decide
const uint point_edge_mask = (1u << 28) - 1u;
// In the word of a field's cell, in place of the last two: the first or last vertex of the edge is
// nearest.
const uint first_vertex_flag = 1u << 28;
const uint last_vertex_flag = 1u << 29;

// Closer to the boundary than this, in cells, single precision cannot decide on which side a point
// lies.
NEARFIELD_FLOAT touching = 1.0 / 32768.0;
// A point inside a shape penetrates it if it is deeper than this fraction of d. Otherwise it
// touches, whatever the technique. Far above what single precision leaves undecided.
NEARFIELD_FLOAT touching_depth = 1.0 / 1024.0;

// Values of an intersection's image: the low byte holds the colour of the paper's Table 1, in which
// white means that both shapes cover the sample; the bits above it hold a run of A's edges where A
// takes part by its boundary.
const uint white = 255u;
const uint run_shift = 8u;
const uint max_runs = 1u << (32u - run_shift);

// The samples that an intersection found in a tile: their number and the box of their cells, both
// corners included; the box is meaningful where count > 0.
struct TileSummary {
    uint count NEARFIELD_DEFAULT(0);
    uint low_column NEARFIELD_DEFAULT(UINT32_MAX);
    uint low_row NEARFIELD_DEFAULT(UINT32_MAX);
    uint high_column NEARFIELD_DEFAULT(0);
    uint high_row NEARFIELD_DEFAULT(0);
    // 0: no sample passed the occlusion query, so there is nothing to search for. Stays 1 in tiles
    // without an occlusion query.
    uint passed NEARFIELD_DEFAULT(1);
};
const uint words_of_summary = 6u;
NEARFIELD_CHECK(sizeof(TileSummary) == 4 * words_of_summary)

// A sample found by an intersection.
struct SampleData {
    uint cell NEARFIELD_DEFAULT(0);  // column | row << 16, within the tile
    uint tile NEARFIELD_DEFAULT(0);
    // Where A takes part by its boundary: in TileBatch::runs, or the edge by the compute technique
    uint run NEARFIELD_DEFAULT(0);
};
const uint words_of_sample = 3u;
NEARFIELD_CHECK(sizeof(SampleData) == 4 * words_of_sample)

NEARFIELD_SHARED_END

#endif
