#version 450
#extension GL_GOOGLE_include_directive : require

// Turns the sums of the blocks of one stage into sums of the blocks before each, a part of them in
// each workgroup, and says how much there is to do in the next stage.

#include "search.glsl"

const uint scan_threads = 128u;
layout(local_size_x = 128) in;

#include "sums.glsl"
#include "totals.glsl"

// Writes the sums before each of four blocks.
void write_four(uint unit, uint before, uvec4 sums) {
    uint second = added(before, sums.x);
    uint third = added(second, sums.y);
    scratch_units[unit] = uvec4(before, second, third, added(third, sums.z));
}

// `first`: word of the first block's sum; `elements`: of all blocks. A thread scans eight.
void scan(uint first, uint elements) {
    uint blocks = (elements + search_block - 1u) / search_block;
    uint own_first = scan_block * gl_WorkGroupID.x;
    if (own_first > 0u && own_first >= blocks) {
        return;
    }
    uint before_all = sum_of_words(push.block_sums, own_first);
    uint begin = own_first + scan_block / scan_threads * gl_LocalInvocationID.x;
    uvec4 low = words_from(begin, push.block_sums, blocks);
    uvec4 high = words_from(begin + 4u, push.block_sums, blocks);
    uint sum = added(sum_of_four(low), sum_of_four(high));
    uint before = added(before_all, sum_before_thread(sum));
    if (begin < blocks) {
        write_four((first + begin) / 4u, before, low);
    }
    if (begin + 4u < blocks) {
        write_four((first + begin) / 4u + 1u, added(before, sum_of_four(low)), high);
    }
    bool is_last = gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x;
    if (is_last && own_first + scan_block >= blocks) {
        write_total(push.stage, added(before, sum), push.capacity);
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
