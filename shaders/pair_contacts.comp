#version 450
#extension GL_GOOGLE_include_directive : require

// What is found of each pair, one thread per pair: how many points of either shape are certainly
// contacts, and whether single precision can tell of all. Without contacts: whether the shapes
// intersect. The reverse of a pair of another part has no row.

#include "search.glsl"
#include "found_points.glsl"
#include "rings_inside.glsl"
#include "pair_totals.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"

// The direction from B to A. If there was no room for that, any other.
uint reverse_of(uint direction) {
    uvec2 own = direction_unit(direction, 3u).zw;
    uvec4 list = scratch_units[push.lists + units_of_list * own.y];
    uint directions = scratch[pair_total];
    uint first = min(list.x, directions - 1u);
    uint count = min(list.z, directions - first);
    while (count > 1u) {
        uint half_count = count / 2u;
        bool is_before = direction_unit(first + half_count, 3u).w <= own.x;
        first += is_before ? half_count : 0u;
        count = is_before ? count - half_count : half_count;
    }
    return first;
}

// The points of a direction that were looked at: the first one, and the end.
uvec2 points_of(uint direction) {
    return uvec2(first_point(direction), first_point(direction + 1u));
}

// The records of those that were found: the first one, and how many.
uvec2 records_of(uvec2 points) {
    uint first = found_before(points.x);
    return uvec2(first, found_before(points.y) - first);
}

// What the search has found about four points.
uvec4 four_words(uint four) {
    uint unit = push.point_units + 4u * four;
    return uvec4(scratch_unit(unit).w, scratch_unit(unit + 1u).w, scratch_unit(unit + 2u).w,
                 scratch_unit(unit + 3u).w);
}

// The contacts among the points of a direction: their number, and flags.
uint contacts_of(uint direction, uvec2 points) {
    vec4 lengths = uintBitsToFloat(direction_unit(direction, 2u));
    // That of the point's place, and roundings of the distance.
    float certain = lengths.x - 1.5 * lengths.y;
    if (points.y - points.x > max_compared_contacts) {
        return row_to_resolve;
    }
    uint count = 0u;
    uint flags = 0u;
    for (uint four = points.x / 4u; 4u * four < points.y; ++four) {
        vec4 near = four_depths(four);
        uvec4 words = four_words(four);
        uvec4 found = uvec4(notEqual(words, uvec4(0u)));
        uvec4 are_near = uvec4(greaterThanEqual(near, vec4(0.0))) &
                         uvec4(lessThanEqual(near, vec4(certain)));
        uvec4 contacts = found & are_near;
        count += contacts.x + contacts.y + contacts.z + contacts.w;
        flags |= (found & ~are_near) != uvec4(0u) ? row_to_resolve : 0u;
        bvec4 inside = equal(words & (point_inside | point_doubtful), uvec4(point_inside));
        flags |= any(inside) ? row_intersects : 0u;
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
    clear_undecided();
    if (exists) {
        uint reverse = reverse_of(direction);
        uvec2 points_of_a = points_of(direction);
        uvec2 points_of_b = points_of(reverse);
        if (is_in_part(direction_unit(direction, 3u).z)) {
            count = count_of(direction, reverse, points_of_a, points_of_b);
        }
        scratch_units[unit] = uvec4(records_of(points_of_a), no_deepest, count);
        of_b = records_of(points_of_b);
    }
    uint before = sum_before(count != 0u ? 1u : 0u, push.block_sums + direction / search_block);
    if (exists) {
        scratch_units[unit + 1u] = uvec4(before, of_b, no_deepest);
    }
}
