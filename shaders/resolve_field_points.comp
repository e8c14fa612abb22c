#version 450
#extension GL_GOOGLE_include_directive : require

// The data from which the host reconstructs a field at a point, one thread per point: the nearest
// feature, the values of the four cells around it and, for central differences, of the eight around
// those.

#include "layout.glsl"
#include "push.h"
#include "nearest.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) readonly buffer Points {
    TilePointData points[];
};
layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;
layout(set = 0, binding = 4) uniform usampler2D feature_image;
layout(set = 0, binding = 5) uniform usampler2D sign_image;

layout(push_constant) uniform Push { ResolveFieldPointsPush push; };

#include "field.glsl"
#include "around.glsl"

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    TilePointData point = points[index];
    TileData tile = tile_at(point.tile);
    ivec2 last = ivec2(tile.width, tile.height) - 1;
    ivec2 low = ivec2(unpacked(point.cell));
    uint word = push.first_word + (index - push.origin) * push.words_per_point;
    ivec2 own = clamp(ivec2(floor(point.position)), ivec2(0), last);
    Nearest nearest;
    field.words[word] = field_feature(tile, point.position, own, nearest);
    for (uint i = 0u; i < push.cells_per_point; ++i) {
        field.words[word + 1u + i] = floatBitsToUint(field_value(tile, low + around[i]));
    }
}
