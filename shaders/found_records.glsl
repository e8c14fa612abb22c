// The points that a search between pairs has found. Include after search.glsl.

#include "pairs.h"

layout(std430, set = 0, binding = 2) readonly buffer Records {
    uvec4 records[];
};

// The first record of a direction, or of those after it: that of the first of the threads that
// looked at its points, which have no points of another direction.
uint first_record(uint direction) {
    uint found = scratch[record_total];
    if (direction >= direction_count()) {
        return found;
    }
    uint point = scratch_unit(push.range_units + direction).x +
                 scratch_word(push.range_blocks + direction / search_block);
    if (point >= scratch[point_total]) {
        return found;
    }
    uint block = point / (points_per_thread * search_block);
    return min(found, scratch_word(push.point_blocks + block) +
                          (scratch_unit(push.point_units + point).x >> local_shift));
}

// The depths of four records, of which the first has a number that four divides.
vec4 four_depths(uint four) {
    return uintBitsToFloat(scratch_unit(push.record_depths / 4u + four));
}

// Which of four records are among `range.y` from `range.x` on.
bvec4 are_among(uint four, uvec2 range) {
    uvec4 number = 4u * four + uvec4(0u, 1u, 2u, 3u);
    return lessThan(number - range.x, range.yyyy);
}
