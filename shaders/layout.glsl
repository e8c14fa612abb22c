// Access to the tiles and to the geometry array (layout.h).

#include "layout.h"
#include "segments.glsl"

// Software drivers load memory one thread at a time, at a cost per load, so words that are needed
// together are loaded four at a time.
layout(std430, set = 0, binding = 0) readonly buffer Tiles {
    uvec4 tile_words[];  // four per tile
};

layout(std430, set = 0, binding = 1) readonly buffer Geometry {
    vec2 geometry[];
};
layout(std430, set = 0, binding = 1) readonly buffer Pairs {
    vec4 pairs[];  // the same memory, two at a time
};

TileData tile_at(uint index) {
    uvec4 a = tile_words[4u * index];
    uvec4 b = tile_words[4u * index + 1u];
    uvec4 c = tile_words[4u * index + 2u];
    uvec4 d = tile_words[4u * index + 3u];
    return TileData(a.x, a.y, a.z, a.w, EdgeListData(b.x, b.y, b.z), EdgeListData(b.w, c.x, c.y),
                    uintBitsToFloat(c.z), uintBitsToFloat(c.w), d.x, uint[3](0u, 0u, 0u));
}

// The groups follow the tiles.
CellGroup group_at(uint index) {
    uvec4 words = tile_words[index];
    return CellGroup(words.x, words.y, words.z, words.w);
}

EdgeData edge_at(uint index) {
    vec4 ends = pairs[index / 2u];
    vec4 rest = pairs[index / 2u + 1u];
    return EdgeData(ends.xy, ends.zw, floatBitsToUint(rest.x), floatBitsToUint(rest.y), rest.z,
                floatBitsToUint(rest.w));
}

// The box (low corner, high corner) of the cluster_size edges of a list from position i on, a
// multiple of cluster_size.
vec4 cluster_box(EdgeListData list, uint i) {
    return pairs[list.clusters / 2u + i / cluster_size];
}

// The edge at position i of a list.
EdgeData list_edge(EdgeListData list, uint i) {
    return edge_at(list.edges + 4u * i);
}

float distance_to_segment(vec2 p, vec2 a, vec2 b) {
    return distance(p, nearest_on_segment(p, a, b));
}

float distance_to_box(vec2 p, vec4 box) {
    return length(way_to_box(p, box));
}
