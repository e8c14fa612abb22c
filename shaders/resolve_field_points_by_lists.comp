#version 450
#extension GL_GOOGLE_include_directive : require

// What the host needs to reconstruct a field at a point, from the lists of edges alone, one thread a
// point: resolve_field_points.comp without images.

#define BLOCKS_ACCESS readonly
#include "layout.glsl"
#include "nearest.glsl"
#include "blocks.glsl"
#include "around.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;

layout(push_constant) uniform Push {
    uint first;
    uint end;
    uint points;           // where they start in the geometry array
    uint first_word;       // where the words of point `origin` start
    uint origin;
    uint words_per_point;  // plan::FieldParts
    uint cells_per_point;  // 4, or 12 for central differences
} push;

float value_at(Tile part, ivec2 cell) {
    vec2 p = vec2(cell) + 0.5 - vec2(part.atlas_x, part.atlas_y);
    float nearest = infinity;
    for (uint first = 0u; first < part.nearest.count; first += cluster_size) {
        uint box = part.nearest.clusters + first / cluster_size * 2u;
        if (distance_to_box(p, geometry[box], geometry[box + 1u]) > nearest) {
            continue;
        }
        uint end = min(first + cluster_size, part.nearest.count);
        for (uint i = first; i < end; ++i) {
            Edge edge = list_edge(part.nearest, i);
            nearest = min(nearest, distance_to_segment(p, edge.a, edge.b));
        }
    }
    return filled_at(part, uvec2(cell)) ? -nearest : nearest;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    vec2 p = geometry[push.points + 2u * index];
    vec2 words = geometry[push.points + 2u * index + 1u];
    Tile part = tiles[floatBitsToUint(words.x)];
    uint corner = floatBitsToUint(words.y);
    ivec2 low = ivec2(corner & 0xffffu, corner >> 16);
    uint word = push.first_word + (index - push.origin) * push.words_per_point;
    Nearest nearest = find_nearest(p, part.nearest, nothing_near);
    bool rival = has_rival(p, part.nearest, nearest, rival_margin(part, nearest));
    uvec2 own = uvec2(floor(p) + vec2(part.atlas_x, part.atlas_y));
    field.words[word] = feature_word(part, p, own, nearest, rival);
    for (uint i = 0u; i < push.cells_per_point; ++i) {
        field.words[word + 1u + i] = floatBitsToUint(value_at(part, low + around[i]));
    }
}
