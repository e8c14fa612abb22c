#version 450
#extension GL_GOOGLE_include_directive : require

// The last step of a part, one thread per pair: the rows of those that have points or intersect, or
// that the CPU decides, one after the other; and how much was counted.

#include "search.glsl"
#include "pairs.h"
#include "found_points.glsl"
#include "pair_totals.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"

layout(std430, set = 0, binding = 2) buffer Rows {
    uvec4 rows[];  // in place of the first one: totals
};
layout(std430, set = 0, binding = 2) buffer RowWords {
    uint row_words[];  // the same memory: behind all rows, the numbers of those that the CPU decides
};

void write_row(uint direction, uint target, uvec4 summary, uvec4 place) {
    uvec4 about = direction_unit(direction, 3u);
    bool has_deepest = place.w != no_deepest;
    uvec4 deepest = has_deepest ? scratch_unit(push.point_units + place.w) : uvec4(0u);
    uint depth = has_deepest ? scratch_word(push.depths + place.w) : 0u;
    uint unit = units_of_row * (target + 1u);
    rows[unit] = uvec4(about.z, about.w, summary.w, summary.x);
    rows[unit + 1u] = uvec4(summary.y, deepest.y, deepest.z, deepest.w);
    rows[unit + 2u] = uvec4(place.y, place.z, has_deepest ? summary.z : no_deepest, depth);
    if ((summary.w & row_undecided) != 0u) {
        uint first = 4u * units_of_row * (push.capacity + 1u);
        row_words[first + atomicAdd(pair_counts[undecided_rows], 1u)] = target;
    }
}

// The pairs of the part, which follow one another. Given ones are all of the part.
uint own_pairs() {
    if (push.instances == 0u) {
        return scratch[pair_total];
    }
    uvec4 first = scratch_unit(push.lists + units_of_list * push.first_instance);
    uvec4 last = scratch_unit(push.lists + units_of_list * (push.end_instance - 1u));
    return last.x + last.z - first.x;
}

// For what stays on the device, where the parts follow one another.
void add_to_parts(uvec4 totals) {
    uvec4 before = push.first_instance == 0u ? uvec4(0u)
                                             : uvec4(scratch[rows_so_far], scratch[records_so_far],
                                                     scratch[overflow_so_far], 0u);
    rows[unit_of_parts_before] = before;
    scratch[rows_so_far] = before.x + totals.x;
    scratch[records_so_far] = before.y + totals.y;
    scratch[overflow_so_far] = before.z | totals.z;
}

// How much was counted, for the host and for results that stay on the device.
void write_totals(uint total) {
    uint overflow = total > push.capacity || !had_room() ? 1u : 0u;
    for (uint stage = 0u; stage < row_total; ++stage) {
        pair_counts[stage] = scratch[first_counted + stage];
    }
    pair_counts[row_total] = total;
    if (scratch[has_too_many_pairs] != 0u) {
        pair_counts[pair_total] = too_many_pairs;
    }
    pair_counts[reverse_pairs] = scratch[pair_total] - min(own_pairs(), scratch[pair_total]);
    uvec4 totals = uvec4(min(total, push.capacity), scratch[record_total], overflow, 0u);
    rows[0] = totals;
    add_to_parts(totals);
}

void main() {
    uint direction = dispatched_index();
    uint block = direction / search_block;
    uint pairs = scratch[pair_total];
    uint before = sum_of_words(push.block_sums, block);
    if (direction < pairs) {
        uvec4 summary = scratch_unit(push.summaries + 2u * direction);
        uvec4 place = scratch_unit(push.summaries + 2u * direction + 1u);
        uint target = before + place.x;
        if (summary.w != 0u && target < push.capacity) {
            write_row(direction, target, summary, place);
        }
    }
    if (direction + 1u == max(pairs, 1u)) {
        write_totals(pairs > 0u ? before + scratch_word(push.block_sums + block) : 0u);
    }
}
