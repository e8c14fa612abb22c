// Sums over the elements of a workgroup, one per thread, and over the blocks of elements before one.
// Called from every thread of the workgroup. Include after search.glsl, in a shader that has declared its
// local size.

const uint max_sum = 1u << 30;  // sums end here; there is never as much room

const uint scan_group = 8u;  // threads whose sums are added first
shared uint thread_sums[gl_WorkGroupSize.x];
shared uint scan_group_sums[gl_WorkGroupSize.x / scan_group];
shared uint sum_of_all;

uint added(uint sum, uint more) {
    return min(sum + min(more, max_sum), max_sum);
}

// Returns the sum over the threads of the workgroup before this one.
uint sum_before_thread(uint own_sum) {
    uint own = gl_LocalInvocationID.x;
    uint group = own / scan_group;
    thread_sums[own] = own_sum;
    barrier();
    uint before = 0u;
    for (uint i = scan_group * group; i < own; ++i) {
        before = added(before, thread_sums[i]);
    }
    if (own % scan_group + 1u == scan_group) {
        scan_group_sums[group] = added(before, own_sum);
    }
    barrier();
    for (uint i = 0u; i < group; ++i) {
        before = added(before, scan_group_sums[i]);
    }
    return before;
}

// Returns the sum of the counts of the threads before this one; the last thread also stores that of
// all at a word of the scratch memory.
uint sum_before(uint count, uint block_word) {
    uint before = sum_before_thread(count);
    if (gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x) {
        shared_scratch[block_word] = added(before, count);
    }
    return before;
}

// Four words of an array from the one of that number on; 0 beyond its end.
uvec4 words_until(uvec4 words, uint number, uint count) {
    return mix(uvec4(0u), words, lessThan(number + uvec4(0u, 1u, 2u, 3u), uvec4(count)));
}

// Four words of an array from the one of that number on, which four divides; 0 beyond its end. `first`:
// the array's first word, the first one of a unit.
uvec4 words_from(uint number, uint first, uint count) {
    uint last = max(count, 1u) - 1u;
    return words_until(scratch_unit((first + min(number, last)) / 4u), number, count);
}

uint sum_of_four(uvec4 words) {
    return added(added(words.x, words.y), added(words.z, words.w));
}

// Returns the sum of the words of an array.
uint sum_of_words(uint first, uint count) {
    uint sum = 0u;
    const uint step = 4u * gl_WorkGroupSize.x;
    // Loads that do not depend on each other overlap in time.
    for (uint i = 4u * gl_LocalInvocationID.x; i < count; i += 4u * step) {
        uvec4 one = words_from(i, first, count);
        uvec4 second = words_from(i + step, first, count);
        uvec4 third = words_from(i + 2u * step, first, count);
        uvec4 last = words_from(i + 3u * step, first, count);
        sum = added(sum, added(sum_of_four(one), sum_of_four(second)));
        sum = added(sum, added(sum_of_four(third), sum_of_four(last)));
    }
    uint before = sum_before_thread(sum);
    if (gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x) {
        sum_of_all = added(before, sum);
    }
    barrier();
    return sum_of_all;
}
