#version 450
#extension GL_GOOGLE_include_directive : require

// The pairs of each instance, one thread per instance: writes those that were kept when they were
// counted or, where there are more, finds them once more. Says where the pairs of each instance and
// their items start, and how many there are of all.

#include "search.glsl"
#include "pairs.glsl"
#include "pair_sums.glsl"
#include "instance_walk.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"
#include "totals.glsl"

uint target;  // of the first pair of the thread's instance

void take_pair(uint a, uint place, uint number) {
    if (target + number < push.capacity) {
        uint word = push.pairs + 2u * (target + number);
        scratch[word] = a;
        scratch[word + 1u] = scratch_unit(level_units[instance_levels] + place).x;
    }
}

void main() {
    find_levels();
    uint a = push.first + dispatched_index();
    uint block = a / search_block;
    uint pairs = sum_of_words(push.block_sums, block);
    uint items = sum_of_words(item_sums(), block);
    if (a < push.instances) {
        uint unit = push.lists + units_of_list * a;
        uvec4 list = scratch_unit(unit);
        target = added(list.x, pairs);
        scratch_units[unit] = uvec4(target, added(list.y, items), list.z, 0u);
        if (list.z > kept_pairs) {
            find_overlapping_boxes(a);
        } else {
            for (uint i = 0u; i < list.z; ++i) {
                take_pair(a, scratch_word(kept_words(a) + i), i);
            }
        }
    }
    if (a + 1u == push.instances) {
        pairs = added(pairs, scratch_word(push.block_sums + block));
        items = added(items, scratch_word(item_sums() + block));
        begin_totals();
        write_total(pair_total, pairs, push.capacity);
        // Without room for all pairs, nothing is known of their items.
        write_total(item_total, items, pairs <= push.capacity ? push.second_capacity : 0u);
    }
}
