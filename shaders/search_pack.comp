#version 450
#extension GL_GOOGLE_include_directive : require

// The points for the host, a thread for as many as in search_points.comp, which threads of a workgroup
// take in turns: those that were found, one after the other, or of these only the points of directions
// of which the row does not tell enough; the places of the others stay free.

#include "search.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) writeonly buffer Records {
    uvec4 records[];  // direction, edge of A, sample on it, word
};

bool is_asked_for(uint direction) {
    uint flags = row_undecided | row_to_resolve;
    return (push.flags & search_packs_all) != 0u ||
           (scratch_unit(push.summaries + 2u * direction).w & flags) != 0u;
}

void pack(uint point, uint before) {
    uvec4 record = scratch_unit(push.point_units + point);
    uint target = before + (record.x >> local_shift);
    if (record.w == 0u || target >= scratch[record_total]) {
        return;
    }
    record.x &= (1u << local_shift) - 1u;
    if (is_asked_for(record.x)) {
        records[target] = record;
    }
}

void main() {
    uint block = dispatched_index() / search_block;
    uint before = scratch_word(push.point_blocks + block);
    uint first = points_per_thread * search_block * block + gl_LocalInvocationID.x;
    for (uint i = 0u; i < points_per_thread; ++i) {
        uint point = first + search_block * i;
        if (point < scratch[point_total]) {
            pack(point, before);
        }
    }
}
