#version 450
#extension GL_GOOGLE_include_directive : require

// How many pairs each instance has, one thread per instance: those with whose boxes its own overlaps
// and whose filters match; where each pair is asked about once, only those with later instances. The
// first ones are kept.

#include "search.glsl"
#include "pairs.glsl"
#include "pair_sums.glsl"
#include "instance_walk.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"

void take_pair(uint a, uint place, uint number) {
    if (number < kept_pairs) {
        scratch[kept_words(a) + number] = place;
    }
}

// No more than max_pairs, which is too many.
uint items_of(uint a, uint count) {
    uint chunks = unit_at(instance_unit(a, 2u).x).x;
    return float(count) * float(chunks) < float(max_pairs) ? count * chunks : max_pairs;
}

void main() {
    find_levels();
    uint a = push.first + dispatched_index();
    bool exists = a < push.instances;
    uint count = exists ? find_overlapping_boxes(a) : 0u;
    uint items = exists ? items_of(a, count) : 0u;
    if (max(count, items) >= max_pairs) {
        scratch[has_too_many_pairs] = 1u;
    }
    uint block = a / search_block;
    uint pairs_before = sum_before(count, push.block_sums + block);
    uint items_before = sum_before(items, item_sums() + block);
    if (exists) {
        scratch_units[push.lists + units_of_list * a] =
            uvec4(pairs_before, items_before, count, 0u);
    }
}
