// Sums over the elements of a workgroup, one per thread. Include after search.glsl.

const uint sum_group = 8u;  // threads whose counts are summed first
shared uint counts[search_block];
shared uint group_counts[search_block / sum_group];

// Returns the sum of the counts of the threads before this one; the last thread also stores the
// sum of all at a word of the scratch memory. Call from every thread of the workgroup.
uint sum_before(uint count, uint block_word) {
    uint own = gl_LocalInvocationID.x;
    uint group = own / sum_group;
    counts[own] = count;
    barrier();
    uint sum = 0u;
    for (uint i = sum_group * group; i < own; ++i) {
        sum += counts[i];
    }
    if (own % sum_group + 1u == sum_group) {
        group_counts[group] = sum + count;
    }
    barrier();
    for (uint i = 0u; i < group; ++i) {
        sum += group_counts[i];
    }
    if (own + 1u == search_block) {
        scratch[block_word] = sum + count;
    }
    return sum;
}
