// Collects the samples of a tile from a hit image: adds them to the tile's summary and lists them
// if requested. A thread reads a strip of cells and reserves space for all its samples at once.
// There are no barriers and no shared memory, which are slow on software drivers. Counting
// continues past the capacity, so the host learns how much space is needed.
//
// The including shader defines hit_at(texel): the number in the hit image.

const uint white = 255u;
const uint run_shift = 8u;

#include "samples.glsl"

// A group's `first`: 1 if samples are listed; `second`: where the numbers of all cells of its tile
// are kept, or not_kept.
layout(push_constant) uniform Push {
    uint first_group;
    uint capacity;  // space for samples
} push;

const uint not_kept = 0xffffffffu;
layout(std430, set = 0, binding = 1) writeonly buffer KeptHits {
    uint kept_hits[];  // one word per cell, 0 if it is no sample
};

// Cells per thread, one above the other; as in passes/collect.cpp.
const uint strip = 8u;

void main() {
    CellGroup group = group_at(push.first_group + gl_WorkGroupID.x);
    Tile tile = tile_at(group.tile);
    uint column = group.cell.x + gl_LocalInvocationID.x;
    uint first_row = group.cell.y + gl_LocalInvocationID.y * strip;
    bool keeps = group.second != not_kept;
    if ((summaries[group.tile].passed == 0u && !keeps) || column >= tile.width ||
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
            kept_hits[group.second + (first_row + i) * tile.width + column] = is_found ? hit : 0u;
        }
    }
    if (found == 0u) {
        return;
    }
    uint count = uint(bitCount(found));
    atomicAdd(summaries[group.tile].count, count);
    atomicMin(summaries[group.tile].low_column, column);
    atomicMin(summaries[group.tile].low_row, first_row + uint(findLSB(found)));
    atomicMax(summaries[group.tile].high_column, column);
    atomicMax(summaries[group.tile].high_row, first_row + uint(findMSB(found)));
    if (group.first == 0u) {
        return;
    }
    uint place = atomicAdd(samples.count, count);
    for (uint i = 0u; i < rows; ++i) {
        if ((found & (1u << i)) != 0u && place < push.capacity) {
            uint word = place * 3u;
            samples.words[word] = column | ((first_row + i) << 16);
            samples.words[word + 1u] = group.tile;
            samples.words[word + 2u] = hit_at(corner + ivec2(0, i)) >> run_shift;
            ++place;
        }
    }
}
