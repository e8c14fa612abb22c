#version 450
#extension GL_GOOGLE_include_directive : require

// The boxes of the levels above the third, in one workgroup. So far no instance has too many pairs.

#include "search.glsl"
#include "pairs.glsl"

layout(local_size_x = 128) in;

// Of the third level above that of the instances, and then of those above it.
shared vec4 boxes[512];

void main() {
    if (gl_LocalInvocationID.x == 0u) {
        scratch[has_too_many_pairs] = 0u;
    }
    uint below = level_size(2u);
    for (uint i = gl_LocalInvocationID.x; i < level_size(3u); i += gl_WorkGroupSize.x) {
        vec4 box = empty_box;
        for (uint j = 8u * i; j < min(8u * i + 8u, below); ++j) {
            box = merged(box, uintBitsToFloat(scratch_unit(level_unit(2u) + j)));
        }
        boxes[i] = box;
        scratch_units[level_unit(3u) + i] = floatBitsToUint(box);
    }
    for (uint level = 4u; level < 6u; ++level) {
        barrier();
        uint i = gl_LocalInvocationID.x;
        vec4 box = empty_box;
        for (uint j = 8u * i; j < min(8u * i + 8u, level_size(level - 1u)); ++j) {
            box = merged(box, boxes[j]);
        }
        barrier();
        if (i < level_size(level)) {
            boxes[i] = box;
            scratch_units[level_unit(level) + i] = floatBitsToUint(box);
        }
    }
}
