#version 450
#extension GL_GOOGLE_include_directive : require

// Fills the masks of fields, in which edges are marked, one thread per row of cells.

#include "fields.glsl"
#include "masks.glsl"

layout(local_size_x = group_size) in;

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    FieldTileData tile = tile_at(tile_of(index, by_row));
    uint words = (unpacked(tile.b.size).x + 31u) / 32u;
    uint first = tile.b.mask + words * (index - tile.first_row);
    uint beyond = 0u;
    for (uint word = words; word > 0u; --word) {
        fill_word(first + word - 1u, beyond);
    }
}
