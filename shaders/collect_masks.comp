#version 450
#extension GL_GOOGLE_include_directive : require

// Collects the samples of overlap tiles that both masks cover, one thread per row of a tile: fills the
// row's words of volumes, adds the samples to the tile's summary and lists them if requested. Counting
// continues past the capacity.

#include "masks.glsl"
#include "push.h"
#include "shapes.glsl"
#include "samples.glsl"

layout(local_size_x = group_size) in;

layout(push_constant) uniform Push { CollectMasksPush push; };

// The tile that a row belongs to.
OverlapData overlap_of(uint index) {
    uint unit = push.overlaps + units_of_overlap * last_of_input(index, 4u * push.overlaps + 3u,
                                                                 push.overlap_count,
                                                                 4u * units_of_overlap);
    uvec4 a = unit_at(unit);
    uvec4 b = unit_at(unit + 1u);
    return OverlapData(a.x, a.y, a.z, a.w, b.x, b.y, b.z, 0u);
}

void list(OverlapData overlap, uint row, uvec2 words, uint first, uint place) {
    uint edges = push.edges + overlap.first_edge + row * unpacked(overlap.size).x;
    for (uint word = words.x; word <= words.y; ++word) {
        uint found = scratch[overlap.mask_a + first + word] & scratch[overlap.mask_b + first + word];
        while (found != 0u && place < push.capacity) {
            uint column = 32u * word + uint(findLSB(found));
            found &= found - 1u;
            uint out_word = place * words_of_sample;
            samples.words[out_word] = column | (row << 16);
            samples.words[out_word + 1u] = overlap.tile;
            samples.words[out_word + 2u] =
                overlap.first_edge == no_edges ? 0u : scratch[edges + column];
            ++place;
        }
    }
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    OverlapData overlap = overlap_of(index);
    uint row = index - overlap.first_row;
    uint words = (unpacked(overlap.size).x + 31u) / 32u;
    uint first = row * words;
    uint beyond_a = 0u;
    uint beyond_b = 0u;
    uint count = 0u;
    uint low = 0u;
    uint high = 0u;
    for (uint word = words; word-- > 0u;) {
        uint a = overlap.mask_a + first + word;
        uint b = overlap.mask_b + first + word;
        uint found = ((overlap.flags & overlap_volume_a) != 0u ? fill_word(a, beyond_a) : scratch[a]) &
                     ((overlap.flags & overlap_volume_b) != 0u ? fill_word(b, beyond_b) : scratch[b]);
        if (found != 0u) {
            high = count == 0u ? 32u * word + uint(findMSB(found)) : high;
            low = 32u * word + uint(findLSB(found));
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
    if ((overlap.flags & overlap_lists) != 0u) {
        list(overlap, row, uvec2(low, high) / 32u, first, atomicAdd(samples.count, count));
    }
}
