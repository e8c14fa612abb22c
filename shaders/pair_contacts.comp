#version 450
#extension GL_GOOGLE_include_directive : require

// What is found of each pair, one thread per pair: how many points of either shape are certainly
// contacts, and whether single precision can tell of all. Without contacts: whether the shapes
// intersect.

#include "search.glsl"
#include "block_sum.glsl"
#include "found_records.glsl"
#include "rings_inside.glsl"

layout(local_size_x = group_size) in;

// The direction from B to A. If there was no room for that, any other.
uint reverse_of(uint direction) {
    uvec2 own = direction_unit(direction, 3u).zw;
    uvec4 list = scratch_units[push.lists + units_of_list * own.y];
    uint directions = scratch[pair_total];
    uint first = min(list.x + scratch[push.pair_blocks + own.y / search_block], directions - 1u);
    uint count = min(list.z, directions - first);
    while (count > 1u) {
        uint half_count = count / 2u;
        bool is_before = direction_unit(first + half_count, 3u).w <= own.x;
        first += is_before ? half_count : 0u;
        count = is_before ? count - half_count : half_count;
    }
    return first;
}

// The consecutive records of a direction: the first one, and how many.
uvec2 records_of(uint direction) {
    uint first = first_record(direction);
    return uvec2(first, first_record(direction + 1u) - first);
}

// What the search has found about four records; 0 for those that are not asked for.
uvec4 four_words(uint four, bvec4 asked) {
    uvec4 words = uvec4(0u);
    for (uint i = 0u; i < 4u; ++i) {
        if (asked[i]) {
            words[i] = records[4u * four + i].w;
        }
    }
    return words;
}

// The contacts among the records of a direction: their number, and flags.
uint contacts_of(uint direction, uvec2 found) {
    vec4 lengths = uintBitsToFloat(direction_unit(direction, 2u));
    // That of the point's place, and roundings of the distance.
    float certain = lengths.x - 1.5 * lengths.y;
    if (found.y > max_compared_contacts) {
        return row_to_resolve;
    }
    uint count = 0u;
    uint flags = 0u;
    for (uint four = found.x / 4u; 4u * four < found.x + found.y; ++four) {
        vec4 near = four_depths(four);
        bvec4 are_own = are_among(four, found);
        uvec4 words = four_words(four, are_own);
        bvec4 are_near = bvec4(uvec4(greaterThanEqual(near, vec4(0.0))) &
                               uvec4(lessThanEqual(near, vec4(certain))));
        uvec4 contacts = uvec4(are_own) & uvec4(are_near);
        count += contacts.x + contacts.y + contacts.z + contacts.w;
        flags |= any(bvec4(uvec4(are_own) & uvec4(not(are_near)))) ? row_to_resolve : 0u;
        bvec4 inside = equal(words & (point_inside | point_doubtful), uvec4(point_inside));
        flags |= any(bvec4(uvec4(are_own) & uvec4(inside))) ? row_intersects : 0u;
    }
    return count | flags;
}

// The count and flags of the row of a pair without a point that may be a contact.
uint intersection_of(uint direction, uint reverse) {
    uint verdict = scratch[push.verdicts + direction] | scratch[push.verdicts + reverse];
    if (verdict == 0u) {
        verdict = find_ring_inside(direction_at(direction));
    }
    return (verdict & pair_meets) != 0u ? row_intersects : verdict != 0u ? row_undecided : 0u;
}

// Those of the row of a pair.
uint count_of(uint direction, uint reverse, uvec2 of_a, uvec2 of_b) {
    if ((scratch[push.verdicts + direction] & pair_left_to_cpu) != 0u) {
        return row_undecided;
    }
    uint by_a = contacts_of(direction, of_a);
    uint by_b = contacts_of(reverse, of_b);
    uint number = (by_a & row_count_mask) + (by_b & row_count_mask);
    uint flags = (by_a | by_b) & ~row_count_mask;
    if (number == 0u && (flags & row_to_resolve) == 0u) {
        return intersection_of(direction, reverse);
    }
    return number > 0u ? number | flags : row_undecided;
}

void main() {
    uint direction = dispatched_index();
    bool exists = direction < scratch[pair_total];
    uint count = 0u;
    uint unit = push.summaries + 2u * direction;
    uvec2 of_b = uvec2(0u);
    if (exists) {
        uint reverse = reverse_of(direction);
        uvec2 of_a = records_of(direction);
        of_b = records_of(reverse);
        count = count_of(direction, reverse, of_a, of_b);
        scratch_units[unit] = uvec4(of_a, no_deepest, count);
    }
    uint before = sum_before(count != 0u ? 1u : 0u, push.row_blocks + direction / search_block);
    if (exists) {
        scratch_units[unit + 1u] = uvec4(before, of_b, 0u);
    }
}
