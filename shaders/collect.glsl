// Collects the samples of a tile from a hit image: adds them to the tile's summary and lists them
// if requested. A thread reads a strip of cells and reserves space for all its samples at once.
// There are no barriers and no shared memory, which are slow on software drivers. Counting
// continues past the capacity, so the host learns how much space is needed.
//
// The including shader defines hit_at(texel): the number in the hit image.

#include "push.h"
#include "samples.glsl"

layout(push_constant) uniform Push { CollectPush push; };

void main() {
    CellGroup group = group_at(push.first_group + gl_WorkGroupID.x);
    TileData tile = tile_at(group.tile);
    uvec2 low = unpacked(group.cell);
    uint column = low.x + gl_LocalInvocationID.x;
    uint first_row = low.y + gl_LocalInvocationID.y * overlap_cells_per_thread;
    if (summaries[group.tile].passed == 0u || column >= tile.width || first_row >= tile.height) {
        return;
    }
    uint rows = min(overlap_cells_per_thread, tile.height - first_row);
    ivec2 corner = ivec2(tile.atlas_x + column, tile.atlas_y + first_row);
    uint found = 0u;
    for (uint i = 0u; i < rows; ++i) {
        found |= (hit_at(corner + ivec2(0, i)) & white) == white ? 1u << i : 0u;
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
            uint word = place * words_of_sample;
            samples.words[word] = column | ((first_row + i) << 16);
            samples.words[word + 1u] = group.tile;
            samples.words[word + 2u] = hit_at(corner + ivec2(0, i)) >> run_shift;
            ++place;
        }
    }
}
