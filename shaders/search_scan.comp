#version 450
#extension GL_GOOGLE_include_directive : require

// Turns the sums of the blocks of one stage into sums of the blocks before each, in one workgroup,
// and writes how much there is to do in the next stage: the arguments of its dispatch, the number
// that was counted, and the number that there is room for. The stage of pairs counts their items
// as well.

#include "search.glsl"

const uint scan_threads = 128u;
layout(local_size_x = 128) in;

layout(std430, set = 0, binding = 3) buffer Arguments {
    uvec4 arguments[];  // by stage: workgroups in three dimensions, number that was counted
};

const uint sum_group = 16u;  // threads whose sums are added first
shared uint sums[scan_threads];
shared uint group_sums[scan_threads / sum_group];
shared uint total_of_all;

const uint max_sum = 1u << 30;  // sums end here; there is never as much room

uint added(uint sum, uint more) {
    return min(sum + min(more, max_sum), max_sum);
}

// Of the steps that look at points.
uint threads_for(uint points) {
    return (points + points_per_thread - 1u) / points_per_thread;
}

// Returns the sum over the threads before this one.
uint sum_before_thread(uint own_sum) {
    uint own = gl_LocalInvocationID.x;
    uint group = own / sum_group;
    sums[own] = own_sum;
    barrier();
    uint before = 0u;
    for (uint i = sum_group * group; i < own; ++i) {
        before = added(before, sums[i]);
    }
    if (own % sum_group + 1u == sum_group) {
        group_sums[group] = added(before, own_sum);
    }
    barrier();
    for (uint i = 0u; i < group; ++i) {
        before = added(before, group_sums[i]);
    }
    return before;
}

// Returns the number that was counted. `first`: word of the first block's sum; `elements`: of all
// blocks.
uint scan(uint stage, uint first, uint elements, uint capacity) {
    uint blocks = (elements + search_block - 1u) / search_block;
    uint share = (blocks + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(gl_LocalInvocationID.x * share, blocks);
    uint end = min(begin + share, blocks);
    uint sum = 0u;
    for (uint i = begin; i < end; ++i) {
        sum = added(sum, scratch[first + i]);
    }
    uint before = sum_before_thread(sum);
    if (gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x) {
        uint total = added(before, sum);
        uint room = min(total, capacity);
        uint threads = stage == point_total ? threads_for(room) : room;
        uint groups = (threads + search_block - 1u) / search_block;
        uint rows = (groups + max_workgroups - 1u) / max_workgroups;
        scratch[stage] = room;
        if (stage < stages_of_pairs) {
            arguments[stage] = uvec4(min(groups, max_workgroups), rows, 1u, total);
        }
        total_of_all = total;
    }
    for (uint i = begin; i < end; ++i) {
        uint own = scratch[first + i];
        scratch[first + i] = before;
        before = added(before, own);
    }
    barrier();
    return total_of_all;
}

void main() {
    if (push.stage == pair_total) {
        uint pairs = scan(pair_total, push.pair_blocks, push.instances, push.capacity);
        // Without room for all pairs, nothing is known of their items.
        scan(item_total, push.list_item_blocks, push.instances,
             pairs <= push.capacity ? push.second_capacity : 0u);
    } else if (push.stage == edge_total) {
        scan(edge_total, push.item_blocks, item_count(), push.capacity);
    } else if (push.stage == edge_point_total) {
        scan(edge_point_total, push.edge_blocks, scratch[edge_total], max_sum);
    } else if (push.stage == point_total) {
        scan(point_total, push.range_blocks, direction_count(), push.capacity);
    } else if (push.stage == record_total) {
        scan(record_total, push.point_blocks, threads_for(scratch[point_total]), push.capacity);
    } else {
        scan(row_total, push.row_blocks, scratch[pair_total], push.capacity);
    }
}
