#version 450
#extension GL_GOOGLE_include_directive : require

// Turns the sums of the blocks of one stage into sums of the blocks before each, in one workgroup,
// and writes how much there is to do in the next stage: the arguments of its dispatch, the number
// that was counted, and the number that there is room for.

#include "search.glsl"

layout(local_size_x = 256) in;

layout(std430, set = 0, binding = 3) buffer Arguments {
    uvec4 arguments[];  // by stage: workgroups in three dimensions, number that was counted
};

shared uint sums[256];

// Of the steps that look at points.
uint threads_for(uint points) {
    return (points + points_per_thread - 1u) / points_per_thread;
}

void main() {
    uint first = push.stage == edge_total    ? push.item_blocks
                 : push.stage == point_total ? push.edge_blocks
                                             : push.point_blocks;
    uint elements = push.stage == edge_total     ? push.items
                    : push.stage == record_total ? threads_for(scratch[point_total])
                                                 : scratch[edge_total];
    uint blocks = (elements + search_block - 1u) / search_block;
    uint share = (blocks + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(gl_LocalInvocationID.x * share, blocks);
    uint end = min(begin + share, blocks);
    uint sum = 0u;
    for (uint i = begin; i < end; ++i) {
        sum += scratch[first + i];
    }
    sums[gl_LocalInvocationID.x] = sum;
    barrier();
    uint before = 0u;
    for (uint i = 0u; i < gl_LocalInvocationID.x; ++i) {
        before += sums[i];
    }
    if (gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x) {
        uint total = before + sum;
        uint room = min(total, push.capacity);
        uint threads = push.stage == point_total ? threads_for(room) : room;
        uint groups = (threads + search_block - 1u) / search_block;
        uint rows = (groups + max_workgroups - 1u) / max_workgroups;
        scratch[push.stage] = room;
        arguments[push.stage] = uvec4(min(groups, max_workgroups), rows, 1u, total);
    }
    for (uint i = begin; i < end; ++i) {
        uint own = scratch[first + i];
        scratch[first + i] = before;
        before += own;
    }
}
