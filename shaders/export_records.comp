#version 450
#extension GL_GOOGLE_include_directive : require

// Writes the records of the points that a search has found for a query, or for one direction of it,
// packed, in the order of the points, in three steps: one thread per block of points counts its
// records; one thread computes the prefix sums of the counts, which give each block's position, and
// writes summary and header; one thread per point writes its record, if it is one. No thread waits for
// another, and the output is deterministic.

#include "nearfield/nearfield.glsl"
#include "search.glsl"
#include "export.h"
#include "found_points.glsl"
#include "exported.glsl"
#include "header.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) buffer Records {
    NearfieldSummary summary;
    NearfieldPoint records[];
};
layout(std430, set = 0, binding = 3) buffer Blocks {
    NearfieldHeader header;
    RecordBlockData blocks[];
};

// Of the push constants: the direction, the step, the flags of its records, and how many records of
// the query there is room for.
#define own_direction push.first
#define own_step push.stage
#define own_flags push.flags

// What a point is to the query.
struct Found {
    bool is_record;
    float depth;  // negative outside, in units of B's frame
};

Found found_at(uint point, SearchDirectionData direction) {
    float size = uintBitsToFloat(scratch_word(push.depths + point));
    if (size < 0.0) {
        // Where a search took too long, the record says that it is undecided.
        return Found(size != nothing_found, -infinity);
    }
    bool is_inside = (scratch_unit(push.point_units + point).w & point_inside) != 0u;
    bool is_record =
        direction.outside != 0.0 ? size <= direction.reach : size > abs(direction.touching);
    return Found(is_record, is_inside && size > abs(direction.touching) ? size : -size);
}

void count_records(uint block, uint begin, uint end) {
    SearchDirectionData direction = direction_at(own_direction);
    RecordBlockData counted = RecordBlockData(0u, 0u, -infinity, 0u);
    for (uint point = begin; point < end; ++point) {
        Found found = found_at(point, direction);
        if (found.is_record) {
            if (found.depth > counted.depth) {
                counted.depth = found.depth;
                counted.deepest = counted.count;
            }
            ++counted.count;
        }
    }
    blocks[block] = counted;
}

// Behind the records of the other direction, if there is one.
void place_blocks(uint count) {
    NearfieldSummary all = summary;
    if ((own_flags & nearfield_on_b_flag) == 0u) {
        all = NearfieldSummary(0u, push.capacity, nearfield_no_point, 0.0);
    }
    float unit = length(push.frame_axis);
    float depth = all.deepest == nearfield_no_point ? -infinity : all.depth;
    for (uint i = 0u; i < count; ++i) {
        RecordBlockData block = blocks[i];
        blocks[i].count = all.count;
        if (block.count > 0u && unit * block.depth > depth) {
            depth = unit * block.depth;
            all.deepest = all.count + block.deepest;
        }
        all.count += block.count;
    }
    if (!had_room()) {
        // There may be any number of others.
        all.count = max(all.count, 1u);
        all.capacity = 0u;
    }
    all.depth = all.deepest == nearfield_no_point ? 0.0 : depth;
    summary = all;
    header = header_of(min(all.count, all.capacity), push.origin, push.cell,
                       all.count > all.capacity);
}

void write_record(uint block, uint begin, uint point) {
    SearchDirectionData direction = direction_at(own_direction);
    if (!found_at(point, direction).is_record) {
        return;
    }
    uint place = blocks[block].count;
    for (uint before = begin; before < point; ++before) {
        place += found_at(before, direction).is_record ? 1u : 0u;
    }
    if (place < summary.capacity) {
        uvec4 record = scratch_unit(push.point_units + point);
        record.x = own_direction;
        records[place] = exported(record, vec4(push.frame_axis, push.frame_place), own_flags);
    }
}

void main() {
    uint first = first_point(own_direction);
    uint end = first_point(own_direction + 1u);
    if (own_step == place_step) {
        if (gl_GlobalInvocationID.x == 0u) {
            place_blocks((end - first + points_per_block - 1u) / points_per_block);
        }
    } else if (own_step == count_step) {
        uint block = dispatched_index();
        uint begin = first + points_per_block * block;
        if (begin < end) {
            count_records(block, begin, min(begin + points_per_block, end));
        }
    } else {
        uint point = first + dispatched_index();
        uint block = dispatched_index() / points_per_block;
        if (point < end) {
            write_record(block, first + points_per_block * block, point);
        }
    }
}
