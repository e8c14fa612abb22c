#version 450
#extension GL_GOOGLE_include_directive : require

// The fill of a mask, second part: one thread per row. A sample is inside if the number of marks at
// or after it is odd (odd-even rule).

#include "masks.glsl"
#include "push.h"

layout(local_size_x = group_size) in;

layout(push_constant) uniform Push { MaskRowsPush push; };

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint row = push.rows + words_of_mask_row * index;
    uint first_word = work[row];
    uint beyond = 0u;  // all ones if the words after have an odd number of marks
    for (uint i = work[row + 1u]; i > 0u; --i) {
        uint word = scratch[first_word + i - 1u];
        word ^= word >> 1;
        word ^= word >> 2;
        word ^= word >> 4;
        word ^= word >> 8;
        word ^= word >> 16;
        word ^= beyond;
        scratch[first_word + i - 1u] = word;
        beyond = (word & 1u) != 0u ? ~0u : 0u;
    }
}
