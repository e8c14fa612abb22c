#version 450
#extension GL_GOOGLE_include_directive : require

// Fills the masks of fields, in which edges are marked, one thread per row.

#include "masks.glsl"
#include "push.h"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 0) readonly buffer Work {
    uint work[];
};

layout(push_constant) uniform Push { MaskRowsPush push; };

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint row = push.rows + words_of_mask_row * index;
    uint first_word = work[row];
    uint beyond = 0u;
    for (uint i = work[row + 1u]; i > 0u; --i) {
        fill_word(first_word + i - 1u, beyond);
    }
}
