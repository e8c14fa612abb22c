#version 450
#extension GL_GOOGLE_include_directive : require

// Which pairs intersect, one thread per pair: those whose boundaries meet, and those of which one
// shape holds a ring of the other.

#include "search.glsl"
#include "rings_inside.glsl"
#include "pair_totals.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"

// The count of the pair's row, with flags; 0 without one.
uint count_of(uint pair) {
    uint verdict = scratch[push.verdicts + pair];
    if (verdict == 0u) {
        verdict = find_ring_inside(direction_at(pair));
    }
    if ((verdict & pair_left_to_cpu) != 0u) {
        return row_undecided;
    }
    return (verdict & pair_meets) != 0u ? 1u : verdict != 0u ? row_undecided : 0u;
}

void main() {
    uint pair = dispatched_index();
    clear_undecided();
    bool exists = pair < scratch[pair_total];
    uint count = exists ? count_of(pair) : 0u;
    uint before = sum_before(count != 0u ? 1u : 0u, push.block_sums + pair / search_block);
    if (exists) {
        scratch_units[push.summaries + 2u * pair] = uvec4(0u, 0u, no_deepest, count);
        scratch_units[push.summaries + 2u * pair + 1u] = uvec4(before, 0u, 0u, no_deepest);
    }
}
