#version 450
#extension GL_GOOGLE_include_directive : require

// The search's last step, one thread per four points, as in the step before: those that were found,
// one after the other.

#include "search.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) writeonly buffer Records {
    uvec4 records[];  // direction, edge of A, sample on it, word
};
layout(std430, set = 0, binding = 2) writeonly buffer RecordWords {
    uint record_words[];  // the same memory: behind all records, their depths for the host
};

void main() {
    uint thread = dispatched_index();
    uint begin = points_per_thread * thread;
    uint end = min(begin + points_per_thread, scratch[point_total]);
    uint target = scratch_word(push.point_blocks + thread / search_block);
    for (uint i = begin; i < end; ++i) {
        uvec4 record = scratch_unit(push.point_units + i);
        if (i == begin) {
            target += record.x >> local_shift;
            record.x &= (1u << local_shift) - 1u;
        }
        if (record.w != 0u && target < scratch[record_total]) {
            uint depth = scratch_word(push.depths + i);
            if (finds_pairs) {
                scratch[push.record_depths + target] = depth;
            } else {
                record_words[4u * push.capacity + target] = depth;
            }
            records[target++] = record;
        }
    }
}
