#version 450
#extension GL_GOOGLE_include_directive : require

// The search's last step, one thread per point: those that were found, one after the other.

#include "search.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 2) writeonly buffer Records {
    uvec4 records[];  // direction, edge of A, sample on it, word
};

const uint local_shift = 26u;

void main() {
    uint index = dispatched_index();
    if (index >= scratch[point_total]) {
        return;
    }
    uvec4 record = scratch_units[push.point_units + index];
    if (record.w != 0u) {
        uint target = scratch[push.point_blocks + index / block_size] + (record.x >> local_shift);
        if (target < scratch[record_total]) {
            record.x &= (1u << local_shift) - 1u;
            records[target] = record;
        }
    }
}
