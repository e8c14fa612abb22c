#version 450
#extension GL_GOOGLE_include_directive : require

// Collects the samples that an intersection found in a tile. A work group reserves room for all its
// samples at once. Counting goes on past the end of the room, so the host sees how much was needed.

#include "layout.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, set = 0, binding = 3) buffer Samples {
    uint count;
    uint words[];  // plan::SampleData: three words a sample
} samples;
layout(set = 0, binding = 4) uniform usampler2D hit_image;

layout(push_constant) uniform Push {
    uint tile;
    uint capacity;  // samples there is room for
} push;

shared uint group_count;
shared uint group_first;

void main() {
    Tile tile = tiles[push.tile];
    uvec2 cell = gl_GlobalInvocationID.xy;
    uint hit = no_feature;
    if (cell.x < tile.width && cell.y < tile.height) {
        hit = texelFetch(hit_image, ivec2(uvec2(tile.atlas_x, tile.atlas_y) + cell), 0).x;
    }

    if (gl_LocalInvocationIndex == 0u) {
        group_count = 0u;
    }
    barrier();
    uint place = 0u;
    if (hit != no_feature) {
        place = atomicAdd(group_count, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_count > 0u) {
        group_first = atomicAdd(samples.count, group_count);
    }
    barrier();
    if (hit != no_feature && group_first + place < push.capacity) {
        uint word = (group_first + place) * 3u;
        samples.words[word] = cell.x | (cell.y << 16);
        samples.words[word + 1u] = push.tile;
        samples.words[word + 2u] = hit;
    }
}
