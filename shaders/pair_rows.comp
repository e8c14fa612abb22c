#version 450
#extension GL_GOOGLE_include_directive : require

// The last step, one thread per pair: the rows of those that have points or intersect, or that the
// CPU decides, one after the other.

#include "search.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 0) readonly buffer Records {
    uvec4 records[];
};
layout(std430, set = 0, binding = 2) buffer Rows {
    uvec4 rows[];  // in place of the first one: the number of those that the CPU decides
};
layout(std430, set = 0, binding = 2) buffer RowWords {
    uint row_words[];  // the same memory: behind all rows, the numbers of these, in any order
};

void main() {
    uint direction = dispatched_index();
    if (direction >= scratch[pair_total]) {
        return;
    }
    uvec4 summary = scratch_unit(push.summaries + 2u * direction);
    uvec4 place = scratch_unit(push.summaries + 2u * direction + 1u);
    uint target = place.x + scratch_word(push.row_blocks + direction / search_block);
    if (summary.w == 0u || target >= scratch[row_total]) {
        return;
    }
    uvec4 about = direction_unit(direction, 3u);
    bool has_deepest = summary.y > 0u && summary.z != no_deepest;
    uvec4 deepest = has_deepest ? records[summary.z] : uvec4(0u);
    uint unit = units_of_row * (target + 1u);
    rows[unit] = uvec4(about.z, about.w, summary.w, summary.x);
    rows[unit + 1u] = uvec4(summary.y, deepest.y, deepest.z, deepest.w);
    rows[unit + 2u] = uvec4(place.y, place.z, summary.z, 0u);
    if ((summary.w & row_undecided) != 0u) {
        uint first = 4u * units_of_row * (push.capacity + 1u);
        row_words[first + atomicAdd(row_words[0], 1u)] = target;
    }
}
