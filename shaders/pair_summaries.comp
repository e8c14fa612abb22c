#version 450
#extension GL_GOOGLE_include_directive : require

// What is found of each pair, one thread per pair: how many of its points are deeper than a touch,
// the deepest, and whether single precision can tell that, or at least that there is one.

#include "search.glsl"
#include "found_points.glsl"
#include "pairs.h"
#include "pair_totals.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"

struct Depths {
    uint found;
    uint count;    // deeper than a touch
    uint deepest;  // among those that were found
    uint point;    // the deepest
    float depth;
    float second;  // the depth of the next one
    bool decided;
    bool any_is_certain;
};

// The larger two of four.
vec2 largest_two(vec4 v) {
    vec2 high = max(v.xz, v.yw);
    vec2 low = min(v.xz, v.yw);
    return vec2(max(high.x, high.y), max(min(high.x, high.y), max(low.x, low.y)));
}

uint sum_of(uvec4 v) {
    return v.x + v.y + v.z + v.w;
}

void consider(vec4 all_four, uint four, float touching, float margin, inout Depths depths) {
    uvec4 found = uvec4(notEqual(all_four, vec4(nothing_found)));
    uvec4 certain = uvec4(greaterThan(abs(all_four - touching), vec4(margin))) &
                    uvec4(greaterThanEqual(all_four, vec4(0.0)));
    uvec4 deep = found & uvec4(greaterThan(all_four, vec4(touching)));
    depths.decided = depths.decided && (found & ~certain) == uvec4(0u);
    depths.any_is_certain =
        depths.any_is_certain ||
        (found & uvec4(greaterThan(all_four, vec4(touching + margin)))) != uvec4(0u);
    vec4 counted = mix(vec4(0.0), all_four, bvec4(deep));
    vec2 largest = largest_two(counted);
    if (largest.x > depths.depth) {
        uint own = counted.x == largest.x   ? 0u
                   : counted.y == largest.x ? 1u
                   : counted.z == largest.x ? 2u
                                            : 3u;
        depths.point = 4u * four + own;
        depths.deepest = depths.found + (own > 0u ? found.x : 0u) + (own > 1u ? found.y : 0u) +
                         (own > 2u ? found.z : 0u);
    }
    depths.second = max(max(largest.y, depths.second), min(largest.x, depths.depth));
    depths.depth = max(largest.x, depths.depth);
    depths.count += sum_of(deep);
    depths.found += sum_of(found);
}

// Four depths; beyond the last four, none.
vec4 depths_until(uint four, uint end) {
    vec4 depths = four_depths(min(four, end - 1u));
    return four < end ? depths : vec4(nothing_found);
}

Depths compare(uint first, uint end, float touching, float margin) {
    Depths depths = Depths(0u, 0u, 0u, 0u, 0.0, 0.0, true, false);
    if (first >= end) {
        return depths;
    }
    // While these are compared, the next ones are on their way.
    uint end_four = (end + 3u) / 4u;
    vec4 next = depths_until(first / 4u, end_four);
    vec4 then = depths_until(first / 4u + 1u, end_four);
    for (uint four = first / 4u; four < end_four; four += 2u) {
        vec4 one = next;
        vec4 other = then;
        next = depths_until(four + 2u, end_four);
        then = depths_until(four + 3u, end_four);
        consider(one, four, touching, margin, depths);
        consider(other, four + 1u, touching, margin, depths);
    }
    return depths;
}

void main() {
    uint direction = dispatched_index();
    bool exists = direction < scratch[pair_total];
    uint count = 0u;
    uint unit = push.summaries + 2u * direction;
    uint point = 0u;
    clear_undecided();
    if (exists) {
        uint first = first_point(direction);
        uint end = first_point(direction + 1u);
        vec4 lengths = uintBitsToFloat(direction_unit(direction, 2u));
        float touching = uintBitsToFloat(direction_unit(direction, 3u).y);
        float margin = depth_margins * lengths.y;
        bool has_all = touching >= 0.0 && end - first <= max_compared_depths;
        Depths depths = compare(first, has_all ? end : first, touching, margin);
        bool has_rival = depths.second >= depths.depth - 2.0 * margin;
        if (!has_all || (!depths.decided && !depths.any_is_certain)) {
            count = row_undecided;
        } else if (depths.count > 0u) {
            count = depths.count | (has_rival || !depths.decided ? row_to_resolve : 0u);
        }
        // Points that nobody asks for have no numbers.
        uint record = push.capacity > 0u ? found_before(first) : 0u;
        uint records = push.capacity > 0u ? found_before(end) - record : 0u;
        point = depths.count > 0u ? depths.point : no_deepest;
        scratch_units[unit] = uvec4(record, records, record + depths.deepest, count);
    }
    uint before = sum_before(count != 0u ? 1u : 0u, push.block_sums + direction / search_block);
    if (exists) {
        scratch_units[unit + 1u] = uvec4(before, 0u, 0u, point);
    }
}
