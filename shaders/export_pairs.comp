#version 450
#extension GL_GOOGLE_include_directive : require

// What stays on the device of the pairs of a world, one thread per row.

#include "nearfield/nearfield.glsl"
#include "push.h"
#include "pairs.h"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 0) readonly buffer Instances {
    uvec4 instances[];
};
layout(std430, set = 0, binding = 1) readonly buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 2) readonly buffer Rows {
    uvec4 rows[];
};
layout(std430, set = 0, binding = 3) writeonly buffer Pairs {
    NearfieldPair pairs[];
};

layout(push_constant) uniform Push { SearchPush push; };

uvec4 instance_unit(uint number, uint i) {
    return instances[units_of_query + units_of_instance * number + i];
}

void main() {
    uint row = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * group_size +
               gl_LocalInvocationID.x;
    if (row >= scratch[row_total]) {
        return;
    }
    uvec4 first = rows[units_of_row * (row + 1u)];
    uvec4 second = rows[units_of_row * (row + 1u) + 1u];
    uvec4 third = rows[units_of_row * (row + 1u) + 2u];
    bool is_undecided = (first.z & row_undecided) != 0u;
    uint flags = is_undecided ? nearfield_undecided_flag : 0u;
    flags |= (first.z & row_to_resolve) != 0u ? nearfield_uncertain_flag : 0u;
    flags |= (first.z & row_intersects) != 0u ? nearfield_intersects_flag : 0u;
    bool has_deepest = !is_undecided && third.z != no_deepest;
    float unit = uintBitsToFloat(instance_unit(first.y, 1u).z);
    float depth = has_deepest ? unit * uintBitsToFloat(scratch[push.record_depths + third.z]) : 0.0;
    pairs[row] = NearfieldPair(instance_unit(first.x, 3u).z, instance_unit(first.y, 3u).z,
                               first.z & row_count_mask, flags, first.w, second.x, third.x, third.y,
                               has_deepest ? third.z : nearfield_no_record, depth);
}
