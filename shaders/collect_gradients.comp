#version 450
#extension GL_GOOGLE_include_directive : require

// Copies blended gradients from their image: those of a whole tile, or of the four cells around
// each point of a range.

#include "layout.glsl"
#include "push.h"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) readonly buffer Points {
    TilePointData points[];
};
layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;
layout(set = 0, binding = 4) uniform sampler2D gradient_image;

layout(push_constant) uniform Push { CollectGradientsPush push; };

void write(uint word, uint tile_index, ivec2 cell) {
    TileData tile = tile_at(tile_index);
    vec2 gradient = texelFetch(gradient_image, ivec2(tile.atlas_x, tile.atlas_y) + cell, 0).xy;
    field.words[word] = floatBitsToUint(gradient.x);
    field.words[word + 1u] = floatBitsToUint(gradient.y);
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    if (push.words_per_point == 0u) {
        uint width = tile_at(push.tile).width;
        write(push.first_word + 2u * index, push.tile, ivec2(index % width, index / width));
        return;
    }
    uint corner = index & 3u;
    TilePointData point = points[index / 4u];
    ivec2 low = ivec2(unpacked(point.cell));
    // After the feature and the four values.
    uint word = push.first_word + (index / 4u - push.origin) * push.words_per_point + 5u;
    write(word + 2u * corner, point.tile, low + ivec2(corner & 1u, corner >> 1));
}
