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

// The units of a group's eight boxes, or of what belongs to them, from `first` on. Those beyond the
// group's last one repeat it: loads that depend on nothing overlap in time.
struct Eight {
    uvec4 units[8];
};

Eight eight_units(uint first, uint last) {
    return Eight(uvec4[8](scratch_unit(first), scratch_unit(first + min(1u, last)),
                          scratch_unit(first + min(2u, last)), scratch_unit(first + min(3u, last)),
                          scratch_unit(first + min(4u, last)), scratch_unit(first + min(5u, last)),
                          scratch_unit(first + min(6u, last)), scratch_unit(first + min(7u, last))));
}

uint overlaps(uvec4 unit, vec4 own, uint bit) {
    vec4 box = uintBitsToFloat(unit);
    bool do_overlap = all(lessThanEqual(box.xy, own.zw)) && all(lessThanEqual(own.xy, box.zw));
    return do_overlap ? 1u << bit : 0u;
}

// The last box of a walk's group, of eight.
uint last_of_group(Walk walk) {
    return min(level_size(walk.level) - 8u * walk.group, 8u) - 1u;
}

// The boxes of a walk's group that overlap with a box; without a loop, since long walks call it in
// each of their steps.
uint group_overlaps(Walk walk, vec4 own) {
    uint last = last_of_group(walk);
    Eight boxes = eight_units(level_units[walk.level] + 8u * walk.group, last);
    uint all_eight = overlaps(boxes.units[0], own, 0u) | overlaps(boxes.units[1], own, 1u) |
                     overlaps(boxes.units[2], own, 2u) | overlaps(boxes.units[3], own, 3u) |
                     overlaps(boxes.units[4], own, 4u) | overlaps(boxes.units[5], own, 5u) |
                     overlaps(boxes.units[6], own, 6u) | overlaps(boxes.units[7], own, 7u);
    return all_eight & ((2u << last) - 1u);
}

uint top_level() {
    uint level = 0u;
    while (level_size(level) > 8u) {
        ++level;
    }
    return level;
}

// `b`: number, category and mask.
uint pair_bit(uvec4 b, uint bit, uint a, uvec2 filter_a, bool is_once) {
    bool is_asked = is_once ? b.x > a : b.x != a;
    return is_asked && (filter_a.x & b.z) != 0u && (b.y & filter_a.y) != 0u ? 1u << bit : 0u;
}

// Of the boxes of a group of the lowest level, one bit each, those of instances that make a pair.
uint pairs_among(uint boxes, Walk walk, uint a, uvec2 filter_a, bool is_once) {
    Eight b = eight_units(level_units[instance_levels] + 8u * walk.group, last_of_group(walk));
    return boxes & (pair_bit(b.units[0], 0u, a, filter_a, is_once) |
                    pair_bit(b.units[1], 1u, a, filter_a, is_once) |
                    pair_bit(b.units[2], 2u, a, filter_a, is_once) |
                    pair_bit(b.units[3], 3u, a, filter_a, is_once) |
                    pair_bit(b.units[4], 4u, a, filter_a, is_once) |
                    pair_bit(b.units[5], 5u, a, filter_a, is_once) |
                    pair_bit(b.units[6], 6u, a, filter_a, is_once) |
                    pair_bit(b.units[7], 7u, a, filter_a, is_once));
}

// The box of instance `a`, which is at its place in the order.
vec4 own_box(uint a) {
    uint place = instance_words[instance_units[0].w + push.instances + a];
    return uintBitsToFloat(scratch_unit(level_units[0] + place));
}

// Returns the number of pairs with instance `a` first, or max_pairs where the walk takes too long.
uint find_pairs(uint a) {
    vec4 own = own_box(a);
    uvec2 filter_a = instance_unit(a, 2u).zw;
    bool is_once = pair_query().is_once != 0u;
    uint count = 0u;
    Walk walk = Walk(top_level(), 0u, uvec2(0u));
    for (uint steps = 0u; steps < max_instance_steps; ++steps) {
        uint boxes = group_overlaps(walk, own);
        if (walk.level == 0u) {
            uint found = pairs_among(boxes, walk, a, filter_a, is_once);
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
