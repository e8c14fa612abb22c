#version 450
#extension GL_GOOGLE_include_directive : require

// What stays on the device of the pairs of a part of a world, one thread per row, behind those of the
// parts before; and how many pairs and records there are so far.

#include "export.h"
#include "nearfield/nearfield.glsl"
#include "push.h"
#include "pairs.h"
#include "header.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 0) readonly buffer Instances {
    uvec4 instances[];
};
struct Header {
    NearfieldHeader header;
    uint unused[words_between_headers - bytes_of_header / 4u];
};
layout(std430, set = 0, binding = 1) writeonly buffer Headers {
    Header headers[2];  // of pairs and records
};
layout(std430, set = 0, binding = 2) readonly buffer Rows {
    uvec4 rows[];  // in place of the first one: totals (pairs.h)
};
layout(std430, set = 0, binding = 3) writeonly buffer Pairs {
    NearfieldPair pairs[];
};

layout(push_constant) uniform Push { ExportPairsPush push; };

uvec4 instance_unit(uint number, uint i) {
    return instances[units_of_query + units_of_instance * number + i];
}

// Of points in a row, those that are written.
uint written(uint first, uint count) {
    return min(count, push.point_room - min(first, push.point_room));
}

// `before`: the rows and records of the parts before.
void write_pair(uint row, uvec2 before) {
    uvec4 first = rows[units_of_row * (row + 1u)];
    uvec4 second = rows[units_of_row * (row + 1u) + 1u];
    uvec4 third = rows[units_of_row * (row + 1u) + 2u];
    bool is_undecided = (first.z & row_undecided) != 0u;
    uint flags = is_undecided ? nearfield_undecided_flag : 0u;
    flags |= (first.z & row_to_resolve) != 0u ? nearfield_uncertain_flag : 0u;
    flags |= (first.z & row_intersects) != 0u ? nearfield_intersects_flag : 0u;
    uint first_of_b = third.y > 0u ? before.y + third.x : third.x;
    bool has_deepest =
        !is_undecided && third.z != no_deepest && written(before.y + third.z, 1u) > 0u;
    float unit = uintBitsToFloat(instance_unit(first.y, 1u).z);
    float depth = has_deepest ? unit * uintBitsToFloat(third.w) : 0.0;
    pairs[before.x + row] = NearfieldPair(
        instance_unit(first.x, 3u).z, instance_unit(first.y, 3u).z, first.z & row_count_mask, flags,
        before.y + first.w, written(before.y + first.w, second.x), first_of_b,
        written(first_of_b, third.y),
        has_deepest ? before.y + third.z : nearfield_no_point, depth);
}

void main() {
    uint row = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * group_size +
               gl_LocalInvocationID.x;
    uvec4 totals = rows[0];
    uvec4 before = rows[unit_of_parts_before];
    if (row < totals.x && before.x + row < push.pair_room) {
        write_pair(row, before.xy);
    }
    if (row == 0u) {
        uvec2 found = before.xy + totals.xy;
        uvec2 stored = min(found, uvec2(push.pair_room, push.point_room));
        bool overflows = (before.z | totals.z) != 0u || found != stored;
        headers[0].header = header_of(stored.x, push.origin, 0.0, overflows);
        headers[1].header = header_of(stored.y, push.origin, 0.0, overflows);
    }
}
