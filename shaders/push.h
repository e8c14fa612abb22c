// The push constants of all passes, for shaders and for C++ (see shared.h). Those of a dispatch
// with one thread per element begin with its first element and the end of all.
#ifndef NEARFIELD_SHADERS_PUSH_H
#define NEARFIELD_SHADERS_PUSH_H

#include "shared.h"

NEARFIELD_SHARED_BEGIN

struct MeshPush {
    vec2 scale;
    vec2 bias;
    float depth_scale;
    uint value;
};

const uint gradient_push_offset = 32u;  // bytes; behind those of the mesh
NEARFIELD_CHECK(sizeof(MeshPush) <= gradient_push_offset)
struct GradientPush {
    int shift;  // 0: write the factor
    float factor;
    float largest;  // maximum magnitude that the format holds
};

struct CollectPush {
    uint first_group;
    uint capacity;  // space for samples
};

struct CollectMasksPush {
    uint first;
    uint end;
    uint overlaps;  // first unit in the input
    uint overlap_count;
    uint edges;     // first word of the cells' edges in the scratch memory
    uint capacity;  // space for samples
};

struct CollectGradientsPush {
    uint first;  // cell of the tile, or cell around a point (four per point)
    uint end;
    uint first_word;  // first word of cell 0, or of point `origin`
    uint origin;
    uint words_per_point;  // 0: a whole tile
    uint tile;
};

struct MaskShapesPush {
    uint first;
    uint end;
    uint shapes;  // first unit in the input
    uint shape_count;
    uint edges;  // first word of the cells' edges in the scratch memory
};

// Of all passes over fields whose lists the device makes (fields.h).
struct FieldPush {
    uint first;
    uint end;
    uint tiles;  // first unit in the input
    uint tile_count;
    uint regions;  // first words of their lists in the scratch memory
    uint quarters;
    uint blocks;    // first word of what tells where their segments are
    uint segments;  // first unit
    uint room;      // for how many; the word before `crowd` counts how many would be needed
    uint numbers;   // first word of the numbers of their edges
    uint crowd;     // first word of the numbers of crowded blocks
    uint resident;  // 1: features are resident and flag nearest vertices
    // Of points of one field:
    uint points;      // first unit of the first one in the input
    uint first_word;  // of its results
    uint words_per_point;
    uint cells_per_point;
};

struct ResolveFieldPush {
    uint first_group;
    uint sign_mask;
};

struct ResolveFieldPointsPush {
    uint first;
    uint end;
    uint sign_mask;
    uint first_word;  // first word of point `origin`
    uint origin;
    uint words_per_point;  // queries::FieldParts
    uint cells_per_point;  // 4, or 12 for central differences
};

struct ResolvePointsPush {
    uint first;
    uint end;
};

struct SearchPush {
    uint first;       // instance, or given direction, of this dispatch
    uint directions;  // first units, and first words, of arrays in the scratch memory
    uint item_blocks;
    uint edge_blocks;
    uint point_blocks;
    uint block_sums;  // of the blocks of the elements that the last dispatch has looked at
    uint item_words;
    uint edge_units;
    uint point_units;
    uint stage;             // that the shader counts
    uint capacity;          // of its elements
    uint second_capacity;   // of items, where pairs are counted
    uint flags;             // search_packs_all, search_crosses
    uint instances;         // their number; 0: the directions are given
    uint boxes;             // first unit: of the instances, then of the levels above them
    uint lists;             // first unit: one per instance, about the pairs in which it is `a`
    uint pairs;             // first word: two per pair, in the order in which they were found
    uint first_directions;  // first word: by block of items
    uint depths;            // first word: by point
    uint summaries;         // first unit: two per pair
    uint verdicts;          // first word: by pair, what is known of their boundaries
    uint frames;            // first unit: by pair, the frame of B in the world
    // The part that is searched: pairs whose `a` is one of these instances, or given directions
    uint first_instance;
    uint end_instance;
    // Of records that stay: B's frame in the world, a unit of its x axis and its centre
    vec2 frame_axis;
    vec2 frame_place;
    vec2 origin;  // of their positions, and the side of a cell: for the header
    float cell;
};
const uint search_packs_all = 1u;  // the host reads all points that were found
const uint search_crosses = 2u;    // the edges of pairs of contacts also cross each other

struct PosePush {
    uint first;  // instance of this dispatch
    uint instances;
    uint stride;     // words from one of the host's poses to the next
    float largest;   // position that is allowed
    float origin;    // of the positions: its largest coordinate
    float farthest;  // beyond it coordinates are too coarse for the tolerance
};

// Of segments and points that ask about a world's instances (world_queries.h).
struct WorldQueryPush {
    uint first;  // segment or point of this dispatch
    uint count;
    uint instances;  // their number
    uint boxes;      // as in SearchPush
    uint answers;    // first unit
    uint category;   // see WorldFilter
    uint mask;
    uint ignored;     // number of an instance, or no_instance
    float magnitude;  // twice the sum of the origin's coordinates
    // Of points:
    float largest;   // distance that counts, rounded up
    uint is_signed;  // 0: distances from edges, also of points inside
    // Of poses: of the shape, as in SearchInstanceData
    uint shape;
    float unit;
    float radius;
};

struct ExportPairsPush {
    vec2 origin;
    uint pair_room;  // pairs and points that may be written
    uint point_room;
};

struct ExportFieldPush {
    uint value;    // word of the first cell's value
    uint feature;  // word of its feature, or not_asked
    uint stride;   // words per row
    uint width;    // cells to copy
    uint height;
    int column;  // of the first cell, in the images
    int row;
    uint rings;  // of B in the tables: the first edge of each, then the number of all edges
    uint ring_count;
    float cell;
    vec2 origin;       // low corner of the field's first cell
    uint field_width;  // cells of the whole field
    uint field_height;
};

struct ExportSamplesPush {
    uint step;
    uint table;        // position of the tile, or of the first one, in the tables
    uint first_tile;   // its index among the query's tiles
    uint tile_count;   // of the tile batch in the first step, of the query in the others
    uint block_count;  // of all rows; 0 if samples are omitted
    uint capacity;
    float cell;
    vec2 origin;
};

NEARFIELD_SHARED_END

#endif
