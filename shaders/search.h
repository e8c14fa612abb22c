// The search for boundary points, for shaders and for C++ (see shared.h). The input is read in
// units of four words.
//
// A shape is given in its own frame, relative to its centre, in units of a power of two near its
// radius, in chunks of edges that are consecutive on one ring: a box per chunk, and levels of boxes
// above, until at most one group is left. Many rings, which may come in any order, are in Morton
// order.
#ifndef NEARFIELD_SHADERS_SEARCH_H
#define NEARFIELD_SHADERS_SEARCH_H

#include "layout.h"

NEARFIELD_SHARED_BEGIN

const uint bytes_of_unit = 16u;
const uint chunk_size = 8u;  // edges per chunk, and boxes per box of the next level
const uint max_levels = 8u;
// Of a shape. The first holds its number of chunks and levels, its first unit of edges (one per
// edge, eight per chunk), and its first word of infos: of each chunk, its first edge << 4 | its
// number of edges; then, of each place along the rings, its chunk.
const uint unit_of_box = 1u;
// Their number, and the first word of their first chunks; then the shape's centre, in the frame of
// its vertices.
const uint unit_of_rings = 2u;
const uint unit_of_first_boxes = 3u;  // a word per level: its first unit
const uint units_of_header = unit_of_first_boxes + max_levels / 4u;

const uint search_block = group_size;  // elements that the device sums at once
const uint points_per_thread = 4u;
// Replaces the first word of the numbers of parts: one point per edge, its first vertex.
const uint no_parts = 0xffffffffu;

// The stages count ordered pairs, which are the directions, their items, edges, points, points that
// were found, and the pairs with an answer. The first words of the scratch memory say of each stage
// how many there are and there is room for, those from first_counted on how many were counted. Each
// has arguments of a dispatch: three numbers of workgroups, of which there is at least one, and how
// many were counted.
const uint edge_total = 0u;
const uint point_total = 1u;
const uint record_total = 2u;
const uint stages = 3u;
const uint pair_total = 3u;
const uint item_total = 4u;
const uint row_total = 5u;
const uint stages_of_pairs = 6u;
const uint first_counted = 8u;
const uint finished_groups = 16u;  // of the dispatch that counts for a stage; 0 between these
const uint words_of_totals = 20u;  // whole units
const uint words_of_item = 2u;     // in the scratch memory: its mask of edges, and its direction
const uint units_of_edge = 2u;
const uint words_of_arguments = 4u;

// The points of A's boundary in the field of B. Positions and lengths in B's frame, relative to its
// centre, in its units.
struct SearchDirectionData {
    vec2 axis;                          // A's x axis, of a unit of A's frame
    vec2 offset;                        // A's centre
    uint shape_a NEARFIELD_DEFAULT(0);  // first units in the input
    uint shape_b NEARFIELD_DEFAULT(0);
    uint parts NEARFIELD_DEFAULT(no_parts);  // first word of the numbers of parts of A's edges
    uint first_item NEARFIELD_DEFAULT(0);    // an item is a chunk of A in one direction
    float reach NEARFIELD_DEFAULT(0.0F);     // from B's boundary to points outside
    float margin NEARFIELD_DEFAULT(0.0F);    // bound on the errors of single precision
    // A second point farther by no more: the nearest is not unique
    float rival NEARFIELD_DEFAULT(0.0F);
    float outside NEARFIELD_DEFAULT(0.0F);  // 1: points outside B are asked for as well
    float doubt NEARFIELD_DEFAULT(0.0F);  // a second edge farther by no more: in doubt; < 0: never
    // Points that are not deeper only touch. Negative, of the same magnitude: the row tells nothing
    // of the points, of which the host asks for all; or, of any, the CPU answers the pair
    float touching NEARFIELD_DEFAULT(-1.0F);
    // Numbers of the instances; of a direction that the host gives, of its query, and nothing
    uint a NEARFIELD_DEFAULT(0);
    uint b NEARFIELD_DEFAULT(0);
};
const uint units_of_direction = 4u;
NEARFIELD_CHECK(sizeof(SearchDirectionData) == 16 * units_of_direction)

// A point that the device has found.
struct FoundPointData {
    uint direction NEARFIELD_DEFAULT(0);
    uint edge NEARFIELD_DEFAULT(0);    // of A
    uint number NEARFIELD_DEFAULT(0);  // among the points of the edge
    uint word NEARFIELD_DEFAULT(0);    // B's nearest edge and flags, as point_inside
};
NEARFIELD_CHECK(sizeof(FoundPointData) == 16)
// The error of a depth in margins: that of the point's place, and roundings of the distance.
NEARFIELD_FLOAT depth_margins = 1.5;

NEARFIELD_SHARED_END

#endif
