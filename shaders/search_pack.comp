#version 450
#extension GL_GOOGLE_include_directive : require

// The search's last step, a thread for as many points as in the step before, which threads of a
// workgroup take in turns: those that were found, one after the other.

#include "search.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) writeonly buffer Records {
    uvec4 records[];  // direction, edge of A, sample on it, word
};
layout(std430, set = 0, binding = 2) writeonly buffer RecordWords {
    uint record_words[];  // the same memory: behind all records, their depths for the host
};

void pack(uint point, uint before) {
    uvec4 record = scratch_unit(push.point_units + point);
    uint target = before + (record.x >> local_shift);
    if (record.w == 0u || target >= scratch[record_total]) {
        return;
    }
    record.x &= (1u << local_shift) - 1u;
    records[target] = record;
    if (!finds_pairs) {
        record_words[4u * push.capacity + target] = scratch_word(push.depths + point);
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
