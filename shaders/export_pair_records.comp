#version 450
#extension GL_GOOGLE_include_directive : require

// What stays on the device of the points of a world's pairs that were found, behind those of the parts
// before, a thread for as many as in search_points.comp, which threads of a workgroup take in turns.
// `push.capacity`: of points that may be written.

#include "nearfield/nearfield.glsl"
#include "search.glsl"
#include "pairs.h"
#include "exported.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 3) writeonly buffer Records {
    NearfieldPoint records[];
};

void main() {
    uint block = dispatched_index() / search_block;
    uint before = scratch_word(push.point_blocks + block);
    uint of_parts = scratch[records_so_far] - scratch[record_total];
    uint first = points_per_thread * search_block * block + gl_LocalInvocationID.x;
    for (uint i = 0u; i < points_per_thread; ++i) {
        uint point = first + search_block * i;
        if (point >= scratch[point_total]) {
            return;
        }
        uvec4 record = scratch_unit(push.point_units + point);
        uint target = before + (record.x >> local_shift);
        record.x &= (1u << local_shift) - 1u;
        if (record.w != 0u && target < scratch[record_total] &&
            of_parts + target < push.capacity) {
            vec4 frame = uintBitsToFloat(scratch_unit(push.frames + record.x));
            records[of_parts + target] = exported(record, frame, 0u);
        }
    }
}
