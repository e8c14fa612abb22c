#version 450
#extension GL_GOOGLE_include_directive : require

// The requested outputs at every cell of a field tile: signed distance, nearest feature.

#include "layout.glsl"
#include "push.h"
#include "nearest.glsl"

layout(local_size_x = field_group_side, local_size_y = field_group_side) in;

layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;
layout(set = 0, binding = 4) uniform usampler2D feature_image;
layout(set = 0, binding = 5) uniform usampler2D sign_image;

layout(push_constant) uniform Push { ResolveFieldPush push; };

#include "field.glsl"

void main() {
    CellGroup group = group_at(push.first_group + gl_WorkGroupID.x);
    uint first_value = group.first;     // first word of the tile's values, or not_asked
    uint first_feature = group.second;  // first word of its features, or not_asked
    TileData tile = tile_at(group.tile);
    ivec2 cell = ivec2(unpacked(group.cell) + gl_LocalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(tile.width, tile.height)))) {
        return;
    }
    uint index = uint(cell.y) * tile.width + uint(cell.x);
    if (first_value != not_asked) {
        field.words[first_value + index] = floatBitsToUint(field_value(tile, cell));
    }
    if (first_feature != not_asked) {
        Nearest nearest;
        field.words[first_feature + index] = field_feature(tile, vec2(cell) + 0.5, cell, nearest);
    }
}
