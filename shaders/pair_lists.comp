#version 450
#extension GL_GOOGLE_include_directive : require

// The pairs of each instance, one thread per instance: those with whose boxes its own overlaps and
// whose filters match; where each pair is asked about once,
// only those with later instances. In the stage of pairs they are
// counted, and after that they are listed.

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

bool is_pair(uvec2 filter_a, uint b) {
    uvec2 filter_b = instance_unit(b, 2u).zw;
    return (filter_a.x & filter_b.y) != 0u && (filter_b.x & filter_a.y) != 0u;
}

void write_pair(uint a, uint b, uint target) {
    if (target < scratch[pair_total]) {
        scratch[push.pairs + 2u * target] = a;
        scratch[push.pairs + 2u * target + 1u] = b;
    }
}

// Returns the number of pairs with instance `a` first.
uint find_pairs(uint a, vec4 own, bool lists, uint target) {
    uvec2 filter_a = instance_unit(a, 2u).zw;
    bool is_once = pair_query().is_once != 0u;
    uint count = 0u;
    Walk walk = Walk(top_level(), 0u, uvec2(0u));
    bool enters = true;
    for (uint i = 0u; i < max_instance_steps; ++i) {
        if (enters) {
            add_boxes(walk, group_overlaps(walk, own));
        }
        uint box;
        if (!next_box(walk, box)) {
            return count;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
            continue;
        }
        uint b = instance_in_order(box);
        if ((is_once ? b > a : b != a) && is_pair(filter_a, b)) {
            if (lists) {
                write_pair(a, b, target + count);
            }
            ++count;
        }
    }
    return max_pairs;
}

uint items_of(uint a, uint count) {
    uint chunks = unit_at(instance_unit(a, 2u).x).x;
    return float(count) * float(chunks) < float(max_pairs) ? count * chunks : max_pairs;
}

void main() {
    uint place = push.first + dispatched_index();
    bool exists = place < push.instances;
    bool lists = push.stage != pair_total;
    uint a = place;
    uint count = 0u;
    if (exists) {
        uint target = 0u;
        if (lists) {
            target = scratch_unit(push.lists + a).x +
                     scratch_word(push.pair_blocks + a / search_block);
        }
        // The box of instance `a` is at its place in the order.
        uint place_of_box = instance_words[instance_units[0].w + push.instances + a];
        vec4 own = uintBitsToFloat(scratch_unit(level_unit(0u) + place_of_box));
        count = find_pairs(a, own, lists, target);
    }
    if (lists) {
        return;
    }
    uint items = exists ? items_of(a, count) : 0u;
    uint pairs_before = sum_before(count, push.pair_blocks + place / search_block);
    uint items_before = sum_before(items, push.list_item_blocks + place / search_block);
    if (exists) {
        scratch_units[push.lists + a] = uvec4(pairs_before, items_before, count, 0u);
    }
}
