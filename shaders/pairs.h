// The pairs of a world's instances that the device finds, for shaders and for C++ (see shared.h).
#ifndef NEARFIELD_SHADERS_PAIRS_H
#define NEARFIELD_SHADERS_PAIRS_H

#include "search.h"

NEARFIELD_SHARED_BEGIN

// What holds for all pairs, at the start of the buffer of instances. World units.
struct PairQueryData {
    float cell NEARFIELD_DEFAULT(0.0F);      // of the samples
    float rival NEARFIELD_DEFAULT(0.0F);     // see SearchDirectionData
    float touching NEARFIELD_DEFAULT(0.0F);  // points that are not deeper only touch
    uint order NEARFIELD_DEFAULT(0);  // first word of the instances in the order of the hierarchy
    float reach NEARFIELD_DEFAULT(0.0F);  // up to which shapes are near each other
    uint is_test NEARFIELD_DEFAULT(0);    // 1: whether shapes meet, or are near each other
    uint is_once NEARFIELD_DEFAULT(0);    // 1: each pair is asked about once, in the given order
    uint unused[1] NEARFIELD_DEFAULT({});
};
const uint units_of_query = 2u;
NEARFIELD_CHECK(sizeof(PairQueryData) == 16 * units_of_query)

// An instance. Positions are relative to an origin near the instances, in world units.
struct SearchInstanceData {
    vec2 axis;                             // its x axis: cosine and sine of its angle
    vec2 high;                             // its shape's centre, rounded
    vec2 low;                              // what the rounding has left out
    float unit NEARFIELD_DEFAULT(0.0F);    // length of a unit of the shape's frame
    float radius NEARFIELD_DEFAULT(0.0F);  // of the shape around its centre, rounded up
    uint shape NEARFIELD_DEFAULT(0);       // first unit in the input
    uint parts NEARFIELD_DEFAULT(no_parts);
    uint category NEARFIELD_DEFAULT(0);  // see WorldInstance
    uint mask NEARFIELD_DEFAULT(0);
    // Not 0: the CPU answers its pairs, because of its shape or of its place
    uint left_to_cpu NEARFIELD_DEFAULT(0);
    // Of its vertices: what is not known to the precision that pairs count on; 0: no matter
    float rounding NEARFIELD_DEFAULT(0.0F);
    uint element NEARFIELD_DEFAULT(0);           // of the host's poses
    float box_rounding NEARFIELD_DEFAULT(0.0F);  // of its vertices, whatever pairs count on
};
const uint units_of_instance = 4u;
NEARFIELD_CHECK(sizeof(SearchInstanceData) == 16 * units_of_instance)

const uint left_by_shape = 1u;  // bits of SearchInstanceData::left_to_cpu
const uint left_by_place = 2u;

// Poses in a buffer of the host's, of which each instance has one: x, y, cosine and sine. The
// device takes them down for the CPU, one unit per instance, behind a unit whose first word is the
// first instance without a usable pose, or no_instance.
const uint no_instance = 0xffffffffu;
// By how much the square of the length of (cosine, sine) may differ from 1.
NEARFIELD_FLOAT allowed_stretch = 1.0 / 64.0;
// Bound on the errors of turning a shape in a dozen operations, of its radius and its centre.
NEARFIELD_FLOAT rounding_of_turn = 1.0 / 1048576.0;
// Bound on the errors of the CPU's double precision, of the coordinates.
NEARFIELD_FLOAT rounding_of_place = 1.0 / 140737488355328.0;

// A pair that has penetrating points or contacts, or intersects, or whose answer the CPU has to
// decide.
struct PairRowData {
    uint a NEARFIELD_DEFAULT(0);  // numbers of the instances
    uint b NEARFIELD_DEFAULT(0);
    uint count NEARFIELD_DEFAULT(0);  // of penetrating points or contacts, or 1; and flags
    // Those that were found, among which they are: consecutive ones
    uint first_point NEARFIELD_DEFAULT(0);
    uint point_count NEARFIELD_DEFAULT(0);
    uint edge NEARFIELD_DEFAULT(0);  // the deepest point, as FoundPointData has it
    uint number NEARFIELD_DEFAULT(0);
    uint word NEARFIELD_DEFAULT(0);
    // Contacts: those of B that were found
    uint first_of_b NEARFIELD_DEFAULT(0);
    uint count_of_b NEARFIELD_DEFAULT(0);
    uint deepest NEARFIELD_DEFAULT(0);    // its record; of contacts: no_deepest
    float depth NEARFIELD_DEFAULT(0.0F);  // its depth, in units of B's frame
};
const uint no_deepest = 0xffffffffu;
// In place of the first row, three units: the rows and records that there are, and whether there
// are more; then the same of all parts before.
const uint unit_of_parts_before = 1u;
// Words of the scratch memory that are free of totals: the same of all parts so far.
const uint rows_so_far = 6u;
const uint records_so_far = 7u;
const uint overflow_so_far = 14u;
// 1: an instance has max_pairs or more, or so many items, and cannot be searched.
const uint has_too_many_pairs = 15u;
NEARFIELD_CHECK(has_too_many_pairs < finished_groups)
// In place of the number of pairs that the host reads, then.
const uint too_many_pairs = 0xfffffffeu;
NEARFIELD_CHECK(stages_of_pairs <= rows_so_far && records_so_far < first_counted)
NEARFIELD_CHECK(first_counted + stages_of_pairs <= overflow_so_far)
// What the host reads beside the rows: by stage, how many were counted; then how many rows the CPU
// decides, and how many of the pairs are reverses of pairs of contacts, of other parts.
const uint undecided_rows = stages_of_pairs;
const uint reverse_pairs = undecided_rows + 1u;
const uint words_of_counts = 8u;         // whole units
const uint words_between_headers = 64u;  // of what stays on the device: a multiple of any alignment
const uint units_of_row = 3u;
NEARFIELD_CHECK(sizeof(PairRowData) == 16 * units_of_row)

// Flags of PairRowData::count.
const uint row_undecided = 1u << 31;  // the CPU has to answer the pair, which may have no row
// It has one, which the CPU makes exact: another point may be as deep, or not all points are
// certain
const uint row_to_resolve = 1u << 30;
const uint row_intersects = 1u << 29;  // the shapes of a pair of contacts intersect for certain
const uint row_count_mask = row_intersects - 1u;

// What is known of the boundaries of two shapes: whether they meet, or are within reach; 0: no.
const uint pair_meets = 1u;
const uint pair_in_doubt = 2u;  // single precision cannot tell
const uint pair_left_to_cpu = 4u;
// Turns of the loop that finds rings of one shape in the other; see max_instance_steps.
const uint max_ring_turns = 3000u;

// A level of the hierarchy of instances has a box per eight boxes of the level below it, until at
// most eight are left.
const uint instance_levels = 6u;  // of as many as there can be
const uint max_instances = 1u << 18u;
// The steps of one walk over the boxes of instances, each of which is one turn of a loop: some
// drivers end the loops of an invocation without notice after 65,535 turns.
const uint max_instance_steps = 60000u;
// So many pairs of each instance are kept while they are counted. Where there are more, a second
// walk lists them.
const uint kept_pairs = 16u;
const uint units_of_list = 1u + kept_pairs / 4u;
// Fewer pairs than this are listed. In place of a number that is too large, or that a walk that is
// too long has not counted.
const uint max_pairs = 1u << 24u;
// Points of one pair whose depths one thread compares, in up to five turns for four points; pairs
// with more are the CPU's.
const uint max_compared_depths = 48000u;
// The same of each direction of a pair of contacts. Loops over both, and the one that finds rings,
// with up to 16 turns of inner loops in each of its own, add up even if neighbouring threads take
// one each.
const uint max_compared_contacts = 5000u;

NEARFIELD_SHARED_END

#endif
