// Sums over the blocks of elements before one. Include after search.glsl, in a shader that has declared
// its local size.

const uint max_sum = 1u << 30;  // sums end here; there is never as much room

const uint scan_group = 16u;  // threads whose sums are added first
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

// Returns the sum of the first words of an array. Call from every thread of the workgroup. `first`:
// the array's first word, the first one of a unit.
uint sum_of_words(uint first, uint count) {
    uint sum = 0u;
    for (uint i = gl_LocalInvocationID.x; 4u * i < count; i += gl_WorkGroupSize.x) {
        uvec4 words = scratch_unit(first / 4u + i);
        words = mix(uvec4(0u), words, lessThan(4u * i + uvec4(0u, 1u, 2u, 3u), uvec4(count)));
        sum = added(added(sum, added(words.x, words.y)), added(words.z, words.w));
    }
    uint before = sum_before_thread(sum);
    if (gl_LocalInvocationID.x + 1u == gl_WorkGroupSize.x) {
        sum_of_all = added(before, sum);
    }
    barrier();
    return sum_of_all;
}
