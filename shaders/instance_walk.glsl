// Walks over the boxes of instances, for the pairs of each. Include after pairs.glsl.

// What the shader does about a pair, the one of that number with instance `a` first. `place`: of the
// other instance in the hierarchy.
void take_pair(uint a, uint place, uint number);

shared uint level_units[instance_levels + 1u];  // level_unit()

// Call from every thread of the workgroup, before any walk.
void find_levels() {
    if (gl_LocalInvocationID.x <= instance_levels) {
        level_units[gl_LocalInvocationID.x] = level_unit(gl_LocalInvocationID.x);
    }
    barrier();
}

uint overlaps(uint unit, bool exists, vec4 own, uint bit) {
    if (!exists) {
        return 0u;
    }
    vec4 box = uintBitsToFloat(scratch_unit(unit + bit));
    return do_overlap(box, own) ? 1u << bit : 0u;
}

// The boxes of a walk's group that overlap with a box; without a loop, since long walks call it in
// each of their steps.
uint group_overlaps(Walk walk, vec4 own) {
    uint unit = level_units[walk.level] + 8u * walk.group;
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

// The instances that `a` makes pairs with: from the first on, so many, without itself.
struct Partners {
    uint first;
    uint count;
    uvec2 filter_a;  // category and mask
};

// Those of the part that is searched. A pair of contacts is answered from both directions, so its
// reverse is searched with it, whatever part that is in.
Partners partners_of(uint a) {
    PairQueryData query = pair_query();
    uvec2 filter_a = instance_unit(a, 2u).zw;
    if (!is_in_part(a)) {
        uint count = asks_outside(query) ? push.end_instance - push.first_instance : 0u;
        return Partners(push.first_instance, count, filter_a);
    }
    uint first = query.is_once != 0u ? a + 1u : 0u;
    return Partners(first, push.instances - first, filter_a);
}

bool is_pair(uint unit, uint a, Partners partners) {
    uvec4 b = scratch_unit(unit);  // number, category and mask
    bool is_asked = b.x - partners.first < partners.count && b.x != a;
    return is_asked && (partners.filter_a.x & b.z) != 0u && (b.y & partners.filter_a.y) != 0u;
}

uint pair_bit(uint unit, uint bit, uint boxes, uint a, Partners partners) {
    return (boxes >> bit & 1u) != 0u && is_pair(unit + bit, a, partners) ? 1u << bit : 0u;
}

// Of the boxes of a group of the lowest level, one bit each, those of instances that make a pair.
uint pairs_among(uint boxes, uint group, uint a, Partners partners) {
    uint unit = level_units[instance_levels] + 8u * group;
    return pair_bit(unit, 0u, boxes, a, partners) | pair_bit(unit, 1u, boxes, a, partners) |
           pair_bit(unit, 2u, boxes, a, partners) | pair_bit(unit, 3u, boxes, a, partners) |
           pair_bit(unit, 4u, boxes, a, partners) | pair_bit(unit, 5u, boxes, a, partners) |
           pair_bit(unit, 6u, boxes, a, partners) | pair_bit(unit, 7u, boxes, a, partners);
}

// The box of instance `a`, which is at its place in the order.
vec4 own_box(uint a) {
    uint place = instance_words[instance_units[0].w + push.instances + a];
    return uintBitsToFloat(scratch_unit(level_units[0] + place));
}

// Returns the number of pairs with instance `a` first, or max_pairs where the walk takes too long.
uint find_overlapping_boxes(uint a) {
    Partners partners = partners_of(a);
    if (partners.count == 0u) {
        return 0u;
    }
    vec4 own = own_box(a);
    uint count = 0u;
    Walk walk = Walk(top_level(), 0u, uvec2(0u));
    for (uint steps = 0u; steps < max_instance_steps; ++steps) {
        uint boxes = group_overlaps(walk, own);
        if (walk.level == 0u) {
            uint found = pairs_among(boxes, walk.group, a, partners);
            steps += bitCount(found);
            for (boxes = 0u; found != 0u; ++count) {
                take_pair(a, 8u * walk.group + take_bit(found), count);
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
