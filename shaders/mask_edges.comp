#version 450
#extension GL_GOOGLE_include_directive : require

// The fill of a mask, first part: one thread per edge. In each row that an edge spans (lower end
// included, upper end excluded) the samples to its left are inverted. Only the last of them is
// marked here; mask_rows.comp inverts those before it.

#include "masks.glsl"
#include "push.h"

layout(local_size_x = group_size) in;

layout(push_constant) uniform Push { MaskEdgesPush push; };

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint word = push.edges + words_of_mask_edge * index;
    ivec2 low = ivec2(work[word], work[word + 1u]);
    ivec2 high = ivec2(work[word + 2u], work[word + 3u]);
    if (low.y > high.y) {
        ivec2 former = low;
        low = high;
        high = former;
    }
    MaskData mask = mask_at(push.masks, work[word + 4u]);
    int end = min(row_from(high.y, push.bits), int(mask.height));
    for (int row = max(row_from(low.y, push.bits), 0); row < end; ++row) {
        uint count = samples_left(low, high, row_centre(row, push.bits), mask.width, push.bits);
        if (count > 0u) {
            uint last = count - 1u;
            atomicXor(scratch[mask.first_word + uint(row) * mask.words_per_row + last / 32u],
                      1u << (last & 31u));
        }
    }
}
