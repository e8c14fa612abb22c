// Searches a tile of a hit image for the samples that an intersection found, sums them up, and
// lists them where a list is asked for. A thread looks at a strip of cells and reserves room for all
// its samples at once; groups without barriers and shared memory are what suits a CPU.
// Counting goes on past the end of the room, so the host sees how much was needed.
//
// The including shader defines hit_at(texel): the number in the hit image.

const uint white = 255u;
const uint run_shift = 8u;

#include "samples.glsl"

layout(push_constant) uniform Push {
    uint tile;
    uint capacity;   // samples there is room for; 0: none are to be listed
    uint first_hit;  // where the numbers of all cells found are kept; not_kept: nowhere
} push;

const uint not_kept = 0xffffffffu;
layout(std430, set = 0, binding = 1) writeonly buffer KeptHits {
    uint kept_hits[];  // a word a cell, 0 where nothing was found
};

// Cells that a thread looks at, one above the other; as in passes/collect.cpp.
const uint strip = 8u;

void main() {
    Tile tile = tile_at(push.tile);
    uint column = gl_GlobalInvocationID.x;
    uint first_row = gl_GlobalInvocationID.y * strip;
    bool keeps = push.first_hit != not_kept;
    if ((summaries[push.tile].passed == 0u && !keeps) || column >= tile.width ||
        first_row >= tile.height) {
        return;
    }
    uint rows = min(strip, tile.height - first_row);
    ivec2 corner = ivec2(tile.atlas_x + column, tile.atlas_y + first_row);
    uint found = 0u;
    for (uint i = 0u; i < rows; ++i) {
        uint hit = hit_at(corner + ivec2(0, i));
        bool is_found = (hit & 255u) == white;
        found |= is_found ? 1u << i : 0u;
        if (keeps) {
            kept_hits[push.first_hit + (first_row + i) * tile.width + column] = is_found ? hit : 0u;
        }
    }
    if (found == 0u) {
        return;
    }
    uint count = uint(bitCount(found));
    atomicAdd(summaries[push.tile].count, count);
    atomicMin(summaries[push.tile].low_column, column);
    atomicMin(summaries[push.tile].low_row, first_row + uint(findLSB(found)));
    atomicMax(summaries[push.tile].high_column, column);
    atomicMax(summaries[push.tile].high_row, first_row + uint(findMSB(found)));
    if (push.capacity == 0u) {
        return;
    }
    uint place = atomicAdd(samples.count, count);
    for (uint i = 0u; i < rows; ++i) {
        if ((found & (1u << i)) != 0u && place < push.capacity) {
            uint word = place * 3u;
            samples.words[word] = column | ((first_row + i) << 16);
            samples.words[word + 1u] = push.tile;
            samples.words[word + 2u] = hit_at(corner + ivec2(0, i)) >> run_shift;
            ++place;
        }
    }
}
