// Sums over the elements of a workgroup, one per thread. Include after search.glsl.

shared uint counts[search_block];

// Returns the sum of the counts of the threads before this one; the last thread also stores the
// sum of all at a word of the scratch memory. Call from every thread of the workgroup.
uint sum_before(uint count, uint block_word) {
    counts[gl_LocalInvocationID.x] = count;
    barrier();
    uint sum = 0u;
    for (uint i = 0u; i < gl_LocalInvocationID.x; ++i) {
        sum += counts[i];
    }
    if (gl_LocalInvocationID.x + 1u == search_block) {
        scratch[block_word] = sum + count;
    }
    return sum;
}
