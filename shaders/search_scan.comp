#version 450
#extension GL_GOOGLE_include_directive : require

// Turns the sums of the blocks of one stage into sums of the blocks before each, a part of them in
// each workgroup, and says how much there is to do in the next stage.

#include "search.glsl"

const uint scan_threads = 128u;
layout(local_size_x = 128) in;

#include "sums.glsl"
#include "totals.glsl"

const uint blocks_per_thread = scan_block / scan_threads;

// `first`: word of the first block's sum; `elements`: of all blocks.
void scan(uint first, uint elements) {
    uint blocks = (elements + search_block - 1u) / search_block;
    uint own_first = scan_block * gl_WorkGroupID.x;
    if (own_first > 0u && own_first >= blocks) {
        return;
    }
    uint before_all = sum_of_words(push.block_sums, own_first);
    uint begin = min(own_first + blocks_per_thread * gl_LocalInvocationID.x, blocks);
    uint end = min(begin + blocks_per_thread, blocks);
    uint sum = 0u;
    for (uint i = begin; i < end; ++i) {
        sum = added(sum, scratch_word(push.block_sums + i));
    }
    uint before = added(before_all, sum_before_thread(sum));
    for (uint i = begin; i < end; ++i) {
        scratch[first + i] = before;
        before = added(before, scratch_word(push.block_sums + i));
    }
    bool is_last = gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x;
    if (is_last && own_first + scan_block >= blocks) {
        write_total(push.stage, before, push.capacity);
    }
}

void main() {
    if (push.stage == edge_total) {
        scan(push.item_blocks, item_count());
    } else if (push.stage == point_total) {
        scan(push.edge_blocks, scratch[edge_total]);
    } else {
        scan(push.point_blocks, threads_for(scratch[point_total]));
    }
}
