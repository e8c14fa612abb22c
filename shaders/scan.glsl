// Counts what the workgroups of a dispatch leave to the next stage. Include after sums.glsl and
// totals.glsl.

shared bool all_have_finished;

// Returns true in the workgroup that finishes last: all others have stored their sums.
bool is_last_group() {
    if (gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x) {  // which has stored that of its own
        memoryBarrierBuffer();
        uint others = gl_NumWorkGroups.x * gl_NumWorkGroups.y - 1u;
        all_have_finished = atomicAdd(shared_scratch[finished_groups], 1u) == others;
    }
    barrier();
    memoryBarrierBuffer();
    return all_have_finished;
}

// The sums of four blocks; 0 beyond the last one.
uvec4 sums_of_blocks(uint four, uint blocks) {
    uint first = push.block_sums + 4u * four;
    uvec4 sums = uvec4(shared_scratch[first], shared_scratch[first + 1u],
                       shared_scratch[first + 2u], shared_scratch[first + 3u]);
    return words_until(sums, 4u * four, blocks);
}

// Turns the sums of the blocks of `elements` into sums of the blocks before each, from the word
// `first` on, and says how much there is to do in the stage that the pass counts for. Called from
// every thread when its workgroup's sum is stored; the last workgroup does it.
void scan(uint first, uint elements) {
    if (!is_last_group()) {
        return;
    }
    uint blocks = (elements + search_block - 1u) / search_block;
    uint fours = (blocks + 3u) / 4u;
    uint own = (fours + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = own * gl_LocalInvocationID.x;
    uint end = min(begin + own, fours);
    uint sum = 0u;
    for (uint four = begin; four < end; ++four) {
        sum = added(sum, sum_of_four(sums_of_blocks(four, blocks)));
    }
    uint before = sum_before_thread(sum);
    for (uint four = begin; four < end; ++four) {
        uvec4 sums = sums_of_blocks(four, blocks);
        uint second = added(before, sums.x);
        uint third = added(second, sums.y);
        uint last = added(third, sums.z);
        scratch_units[first / 4u + four] = uvec4(before, second, third, last);
        before = added(last, sums.w);
    }
    if (gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x) {
        write_total(push.stage, before, push.capacity);
        shared_scratch[finished_groups] = 0u;
    }
}
