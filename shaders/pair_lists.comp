#version 450
#extension GL_GOOGLE_include_directive : require

// The pairs of each instance, one thread per instance: those with whose boxes its own overlaps and
// whose filters match; where each pair is asked about once, only those with later instances. In the
// stage of pairs they are counted, and after that they are listed.

#include "search.glsl"
#include "block_sum.glsl"
#include "pairs.glsl"

layout(local_size_x = group_size) in;

uint overlaps(uint unit, bool exists, vec4 own, uint bit) {
    if (!exists) {
        return 0u;
    }
    vec4 box = uintBitsToFloat(scratch_unit(unit + bit));
    bool do_overlap = all(lessThanEqual(box.xy, own.zw)) && all(lessThanEqual(own.xy, box.zw));
    return do_overlap ? 1u << bit : 0u;
}

// The boxes of a walk's group that overlap with a box; without a loop, since long walks call it in
// each of their steps.
uint group_overlaps(Walk walk, vec4 own) {
    uint unit = level_unit(walk.level) + 8u * walk.group;
    uint count = level_size(walk.level) - 8u * walk.group;
    return overlaps(unit, true, own, 0u) | overlaps(unit, count > 1u, own, 1u) |
           overlaps(unit, count > 2u, own, 2u) | overlaps(unit, count > 3u, own, 3u) |
           overlaps(unit, count > 4u, own, 4u) | overlaps(unit, count > 5u, own, 5u) |
           overlaps(unit, count > 6u, own, 6u) | overlaps(unit, count > 7u, own, 7u);
}

uint top_level() {
    uint level = 0u;
    while (level_size(level) > 8u) {
        ++level;
    }
    return level;
}

bool is_pair(uint unit, uint a, uvec2 filter_a, bool is_once) {
    uvec4 b = scratch_unit(unit);  // number, category and mask
    bool is_asked = is_once ? b.x > a : b.x != a;
    return is_asked && (filter_a.x & b.z) != 0u && (b.y & filter_a.y) != 0u;
}

uint pair_bit(uint unit, uint bit, uint boxes, uint a, uvec2 filter_a, bool is_once) {
    return (boxes >> bit & 1u) != 0u && is_pair(unit + bit, a, filter_a, is_once) ? 1u << bit : 0u;
}

// Of the boxes of a group of the lowest level, one bit each, those of instances that make a pair.
uint pairs_among(uint boxes, uint group, uint a, uvec2 filter_a, bool is_once) {
    uint unit = place_unit(8u * group);
    return pair_bit(unit, 0u, boxes, a, filter_a, is_once) |
           pair_bit(unit, 1u, boxes, a, filter_a, is_once) |
           pair_bit(unit, 2u, boxes, a, filter_a, is_once) |
           pair_bit(unit, 3u, boxes, a, filter_a, is_once) |
           pair_bit(unit, 4u, boxes, a, filter_a, is_once) |
           pair_bit(unit, 5u, boxes, a, filter_a, is_once) |
           pair_bit(unit, 6u, boxes, a, filter_a, is_once) |
           pair_bit(unit, 7u, boxes, a, filter_a, is_once);
}

// The first word of the places of an instance's pairs, as far as they are kept.
uint kept_words(uint a) {
    return 4u * (push.lists + units_of_list * a + 1u);
}

void write_pair(uint a, uint place, uint target) {
    if (target < scratch[pair_total]) {
        scratch[push.pairs + 2u * target] = a;
        scratch[push.pairs + 2u * target + 1u] = scratch_unit(place_unit(place)).x;
    }
}

// Returns the number of pairs with instance `a` first. `lists`: writes them from `target` on;
// otherwise the places of the first ones are kept.
uint find_pairs(uint a, vec4 own, bool lists, uint target) {
    uvec2 filter_a = instance_unit(a, 2u).zw;
    bool is_once = pair_query().is_once != 0u;
    uint count = 0u;
    Walk walk = Walk(top_level(), 0u, uvec2(0u));
    for (uint steps = 0u; steps < max_instance_steps; ++steps) {
        uint boxes = group_overlaps(walk, own);
        if (walk.level == 0u) {
            uint found = pairs_among(boxes, walk.group, a, filter_a, is_once);
            steps += bitCount(found);
            for (boxes = 0u; found != 0u; ++count) {
                uint place = 8u * walk.group + take_bit(found);
                if (lists) {
                    write_pair(a, place, target + count);
                } else if (count < kept_pairs) {
                    scratch[kept_words(a) + count] = place;
                }
            }
        }
        add_boxes(walk, boxes);
        uint box;
        if (!next_box(walk, box)) {
            return count;
        }
        descend(walk, box);
    }
    return max_pairs;
}

// Writes the pairs with instance `a` first.
void list_pairs(uint a, vec4 own) {
    uvec4 list = scratch_unit(push.lists + units_of_list * a);
    uint target = list.x + scratch_word(push.pair_blocks + a / search_block);
    if (list.z > kept_pairs) {
        find_pairs(a, own, true, target);
        return;
    }
    for (uint i = 0u; i < list.z; ++i) {
        write_pair(a, scratch_word(kept_words(a) + i), target + i);
    }
}

uint items_of(uint a, uint count) {
    uint chunks = unit_at(instance_unit(a, 2u).x).x;
    return float(count) * float(chunks) < float(max_pairs) ? count * chunks : max_pairs;
}

void main() {
    uint a = push.first + dispatched_index();
    bool exists = a < push.instances;
    vec4 own = empty_box;
    if (exists) {
        // The box of instance `a` is at its place in the order.
        uint place = instance_words[instance_units[0].w + push.instances + a];
        own = uintBitsToFloat(scratch_unit(level_unit(0u) + place));
    }
    if (push.stage != pair_total) {
        if (exists) {
            list_pairs(a, own);
        }
        return;
    }
    uint count = exists ? find_pairs(a, own, false, 0u) : 0u;
    uint items = exists ? items_of(a, count) : 0u;
    uint pairs_before = sum_before(count, push.pair_blocks + a / search_block);
    uint items_before = sum_before(items, push.list_item_blocks + a / search_block);
    if (exists) {
        scratch_units[push.lists + units_of_list * a] =
            uvec4(pairs_before, items_before, count, 0u);
    }
}
