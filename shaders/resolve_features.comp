#version 450
#extension GL_GOOGLE_include_directive : require

// The nearest feature at every cell of a field, one thread per cell of a block.

#include "layout.glsl"
#include "push.h"
#include "nearest.glsl"
#include "blocks.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;

layout(push_constant) uniform Push { ResolveFeaturesPush push; };

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    TileData block = tile_at(index / (block_side * block_side));
    uvec2 in_block = uvec2(index % block_side, index / block_side % block_side);
    if (block.first_feature == not_asked || in_block.x >= block.width ||
        in_block.y >= block.height) {
        return;
    }
    uvec2 cell = uvec2(block.atlas_x, block.atlas_y) + in_block;
    vec2 p = vec2(cell) + 0.5;
    Nearest nearest;
    uint word = feature_at(block, p, cell, nearest);
    if (push.resident != 0u) {
        word |= vertex_flags(p, block.nearest, nearest);
    }
    field.words[block.first_feature + cell.y * block.tile_width + cell.x] = word;
}
