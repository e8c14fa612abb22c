// The structures of engine/plan/gpu_layout.hpp (std430), and access to the geometry array. Lengths
// are in cells of the tile, positions relative to its low corner.

const uint no_feature = 0xffffffffu;
const uint cluster_size = 8u;

struct EdgeList {
    uint clusters;
    uint edges;
    uint count;
};

struct Tile {
    uint atlas_x;
    uint atlas_y;
    uint width;
    uint height;
    EdgeList nearest;
    EdgeList crossing;
    float settled;
    float margin;
    uint outside;
    uint tile_width;
    uint mask;
    uint first_feature;
};

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

Tile tile_at(uint index) {
    uvec4 a = tile_words[4u * index];
    uvec4 b = tile_words[4u * index + 1u];
    uvec4 c = tile_words[4u * index + 2u];
    uvec4 d = tile_words[4u * index + 3u];
    return Tile(a.x, a.y, a.z, a.w, EdgeList(b.x, b.y, b.z), EdgeList(b.w, c.x, c.y),
                uintBitsToFloat(c.z), uintBitsToFloat(c.w), d.x, d.y, d.z, d.w);
}

// A rectangle of cells that one workgroup works on; they follow the tiles.
struct CellGroup {
    uint tile;
    uvec2 cell;  // the low one
    uint first;
    uint second;
};

CellGroup group_at(uint index) {
    uvec4 words = tile_words[index];
    return CellGroup(words.x, uvec2(words.y & 0xffffu, words.y >> 16), words.z, words.w);
}

struct Edge {
    vec2 a;
    vec2 b;
    uint run;
    uint run_count;
    float deviation;
    uint first_edge;
};

Edge edge_at(uint index) {
    vec4 ends = pairs[index / 2u];
    vec4 rest = pairs[index / 2u + 1u];
    return Edge(ends.xy, ends.zw, floatBitsToUint(rest.x), floatBitsToUint(rest.y), rest.z,
                floatBitsToUint(rest.w));
}

// The box (low corner, high corner) of the cluster_size edges of a list from position i on, a
// multiple of cluster_size.
vec4 cluster_box(EdgeList list, uint i) {
    return pairs[list.clusters / 2u + i / cluster_size];
}

// The edge at position i of a list.
Edge list_edge(EdgeList list, uint i) {
    return edge_at(list.edges + 4u * i);
}

// Parameter of the point of a segment nearest to p: 0 at a, 1 at b.
float along_segment(vec2 p, vec2 a, vec2 b) {
    vec2 d = b - a;
    float squared = dot(d, d);
    return squared > 0.0 ? clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0.0;
}

vec2 nearest_on_segment(vec2 p, vec2 a, vec2 b) {
    return a + along_segment(p, a, b) * (b - a);
}

float distance_to_segment(vec2 p, vec2 a, vec2 b) {
    return distance(p, nearest_on_segment(p, a, b));
}

float distance_to_box(vec2 p, vec4 box) {
    return length(max(max(box.xy - p, p - box.zw), vec2(0.0)));
}
