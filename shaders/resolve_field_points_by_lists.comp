#version 450
#extension GL_GOOGLE_include_directive : require

// The data from which the host reconstructs a field at a point, one thread per point: as
// resolve_field_points.comp, but from edge lists and fill masks in place of images.

#include "layout.glsl"
#include "push.h"
#include "nearest.glsl"
#include "blocks.glsl"
#include "around.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;

layout(push_constant) uniform Push { ResolveFieldPointsByListsPush push; };

float value_at(TileData block, ivec2 cell) {
    vec2 p = vec2(cell) + 0.5;
    float nearest = infinity;
    for (uint first = 0u; first < block.nearest.count; first += cluster_size) {
        if (distance_to_box(p, cluster_box(block.nearest, first)) > nearest) {
            continue;
        }
        uint end = min(first + cluster_size, block.nearest.count);
        for (uint i = first; i < end; ++i) {
            EdgeData edge = list_edge(block.nearest, i);
            nearest = min(nearest, distance_to_segment(p, edge.a, edge.b));
        }
    }
    return filled_at(block, uvec2(cell)) ? -nearest : nearest;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    vec4 point = pairs[push.points / 2u + index];
    vec2 p = point.xy;
    TileData block = tile_at(floatBitsToUint(point.z));
    uint corner = floatBitsToUint(point.w);
    ivec2 low = ivec2(unpacked(corner));
    uint word = push.first_word + (index - push.origin) * push.words_per_point;
    Nearest nearest;
    field.words[word] = feature_at(block, p, uvec2(floor(p)), nearest);
    for (uint i = 0u; i < push.cells_per_point; ++i) {
        field.words[word + 1u + i] = floatBitsToUint(value_at(block, low + around[i]));
    }
}
