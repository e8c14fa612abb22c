#version 450
#extension GL_GOOGLE_include_directive : require

// Counts contacts, one thread for each: the host dispatches as many groups as the header says.

#include "nearfield/nearfield.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Contacts {
    NearfieldSummary summary;
    NearfieldPoint points[];
};
layout(std430, set = 0, binding = 1) buffer Counts {
    uint all;
    uint inside;  // the other shape
};

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index < summary.count) {
        atomicAdd(all, 1u);
        if (nearfield_depth(points[index]) > 0.0) {
            atomicAdd(inside, 1u);
        }
    }
}
