#version 450
#extension GL_GOOGLE_include_directive : require

// Collects the samples of overlap tiles that both masks cover, one thread per row of a tile: adds
// them to the tile's summary and lists them if requested. Counting continues past the capacity.

#include "masks.glsl"
#include "overlaps.glsl"
#include "push.h"
#include "samples.glsl"

layout(local_size_x = group_size) in;

layout(push_constant) uniform Push { CollectMasksPush push; };

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint own = push.rows + words_of_overlap_row * index;
    OverlapData overlap = overlap_at(push.overlaps, work[own]);
    uint row = work[own + 1u];
    MaskData a = mask_at(push.masks, overlap.mask_a);
    uint words_a = a.first_word + row * a.words_per_row;
    uint words_b = mask_at(push.masks, overlap.mask_b).first_word + row * a.words_per_row;
    uint count = 0u;
    uint low = 0u;
    uint high = 0u;
    for (uint word = 0u; word < a.words_per_row; ++word) {
        uint found = scratch[words_a + word] & scratch[words_b + word];
        if (found != 0u) {
            low = count == 0u ? 32u * word + uint(findLSB(found)) : low;
            high = 32u * word + uint(findMSB(found));
            count += uint(bitCount(found));
        }
    }
    if (count == 0u) {
        return;
    }
    atomicAdd(summaries[overlap.tile].count, count);
    atomicMin(summaries[overlap.tile].low_column, low);
    atomicMax(summaries[overlap.tile].high_column, high);
    atomicMin(summaries[overlap.tile].low_row, row);
    atomicMax(summaries[overlap.tile].high_row, row);
    if (overlap.list == 0u) {
        return;
    }
    uint place = atomicAdd(samples.count, count);
    uint runs = push.runs + overlap.first_run + row * a.width;
    for (uint word = low / 32u; word <= high / 32u; ++word) {
        uint found = scratch[words_a + word] & scratch[words_b + word];
        while (found != 0u && place < push.capacity) {
            uint column = 32u * word + uint(findLSB(found));
            found &= found - 1u;
            uint out_word = place * words_of_sample;
            samples.words[out_word] = column | (row << 16);
            samples.words[out_word + 1u] = overlap.tile;
            samples.words[out_word + 2u] =
                overlap.first_run == no_runs ? 0u : scratch[runs + column];
            ++place;
        }
    }
}
