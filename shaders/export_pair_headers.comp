#version 450
#extension GL_GOOGLE_include_directive : require

// How many pairs and records stay on the device. One thread.

#include "nearfield/nearfield.glsl"
#include "push.h"
#include "pairs.h"

layout(local_size_x = 1) in;

layout(std430, set = 0, binding = 0) readonly buffer Arguments {
    uvec4 arguments[];  // by stage: workgroups in three dimensions, number that was counted
};
layout(std430, set = 0, binding = 3) writeonly buffer Headers {
    uint headers[];  // two NearfieldHeader, words_between_headers apart
};

layout(push_constant) uniform Push { ExportPairsPush push; };

void write_header(uint word, uint stage, uint overflow) {
    uint count = min(arguments[stage].w, push.capacities[stage]);
    uint[18] header = uint[18](
        count, 1u, 0u, 0u,  // points
        6u, count, 0u, 0u,  // quads
        (count + group_size - 1u) / group_size, 1u, 1u,  // groups
        count, floatBitsToUint(push.origin.x), floatBitsToUint(push.origin.y), 0u, overflow, 0u, 0u);
    for (uint i = 0u; i < 18u; ++i) {
        headers[word + i] = header[i];
    }
}

void main() {
    uint overflow = 0u;
    for (uint stage = 0u; stage < stages_of_pairs; ++stage) {
        overflow |= arguments[stage].w > push.capacities[stage] ? 1u : 0u;
    }
    write_header(0u, row_total, overflow);
    write_header(words_between_headers, record_total, overflow);
}
