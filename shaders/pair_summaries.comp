#version 450
#extension GL_GOOGLE_include_directive : require

// What is found of each pair, one thread per pair: how many of its points are deeper than a touch,
// the deepest, and whether single precision can tell.

#include "search.glsl"
#include "block_sum.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) readonly buffer Records {
    uvec4 records[];
};

// The first record of a direction, or of those after it.
uint first_record(uint direction) {
    uint first = 0u;
    uint count = scratch[record_total];
    while (count > 0u) {
        uint half_count = count / 2u;
        if (records[first + half_count].x < direction) {
            first += half_count + 1u;
            count -= half_count + 1u;
        } else {
            count = half_count;
        }
    }
    return first;
}

struct Depths {
    uint count;
    uint deepest;  // record
    float depth;
    float second;  // the depth of the next one
    bool decided;
};

Depths compare(uint first, uint end, float touching, float margin) {
    Depths depths = Depths(0u, first, 0.0, 0.0, true);
    for (uint i = first; i < end; ++i) {
        float depth = uintBitsToFloat(scratch_word(push.record_depths + i));
        depths.decided = depths.decided && depth >= 0.0 && abs(depth - touching) > margin;
        if (depth > touching) {
            ++depths.count;
            bool deeper = depth > depths.depth;
            depths.second = deeper ? depths.depth : max(depths.second, depth);
            depths.deepest = deeper ? i : depths.deepest;
            depths.depth = max(depth, depths.depth);
        }
    }
    return depths;
}

void main() {
    uint direction = dispatched_index();
    bool exists = direction < scratch[pair_total];
    uint first, end;
    uint count = 0u;
    uint unit = push.summaries + 2u * direction;
    if (exists) {
        first = first_record(direction);
        end = first_record(direction + 1u);
        vec4 lengths = uintBitsToFloat(direction_unit(direction, 2u));
        float touching = uintBitsToFloat(direction_unit(direction, 3u).y);
        // That of the point's place, and roundings of the distance.
        float margin = 1.5 * lengths.y;
        bool is_short = end - first <= max_compared_depths;
        Depths depths = compare(first, is_short ? end : first, touching, margin);
        bool decided = touching >= 0.0 && is_short && depths.decided;
        bool has_rival = depths.second >= depths.depth - 2.0 * margin;
        count = depths.count | (decided ? 0u : row_undecided) | (has_rival ? row_has_rival : 0u);
        count = depths.count == 0u && decided ? 0u : count;
        scratch_units[unit] = uvec4(first, end - first, depths.deepest, count);
    }
    uint before = sum_before(count != 0u ? 1u : 0u, push.row_blocks + direction / search_block);
    if (exists) {
        scratch_units[unit + 1u] = uvec4(before, 0u, 0u, 0u);
    }
}
