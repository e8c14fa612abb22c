#version 450
#extension GL_GOOGLE_include_directive : require

// What is found of each pair, one thread per pair: how many of its points are deeper than a touch,
// the deepest, and whether single precision can tell that, or at least that there is one.

#include "search.glsl"
#include "block_sum.glsl"
#include "found_records.glsl"

layout(local_size_x = group_size) in;

struct Depths {
    uint count;
    uint deepest;  // record
    float depth;
    float second;  // the depth of the next one
    bool decided;
    bool any_is_certain;
};

void consider(uint record, float depth, float touching, float margin, inout Depths depths) {
    depths.decided = depths.decided && depth >= 0.0 && abs(depth - touching) > margin;
    depths.any_is_certain = depths.any_is_certain || depth > touching + margin;
    if (depth > touching) {
        ++depths.count;
        bool deeper = depth > depths.depth;
        depths.second = deeper ? depths.depth : max(depths.second, depth);
        depths.deepest = deeper ? record : depths.deepest;
        depths.depth = max(depth, depths.depth);
    }
}

Depths compare(uint first, uint end, float touching, float margin) {
    Depths depths = Depths(0u, first, 0.0, 0.0, true, false);
    for (uint four = first / 4u; 4u * four < end; ++four) {
        vec4 four_of_them = four_depths(four);
        bvec4 are_own = are_among(four, uvec2(first, end - first));
        for (uint i = 0u; i < 4u; ++i) {
            if (are_own[i]) {
                consider(4u * four + i, four_of_them[i], touching, margin, depths);
            }
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
        bool has_all = touching >= 0.0 && is_short;
        bool has_rival = depths.second >= depths.depth - 2.0 * margin;
        if (!has_all || (!depths.decided && !depths.any_is_certain)) {
            count = row_undecided;
        } else if (depths.count > 0u) {
            count = depths.count | (has_rival || !depths.decided ? row_to_resolve : 0u);
        }
        scratch_units[unit] = uvec4(first, end - first, depths.deepest, count);
    }
    uint before = sum_before(count != 0u ? 1u : 0u, push.row_blocks + direction / search_block);
    if (exists) {
        scratch_units[unit + 1u] = uvec4(before, 0u, 0u, 0u);
    }
}
