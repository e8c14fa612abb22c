// The structures of engine/plan/gpu_layout.hpp (std430), and how to read the geometry array.
// Lengths are in cells of the tile, positions relative to its low corner.

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

layout(std430, set = 0, binding = 0) readonly buffer Tiles {
    Tile tiles[];
};

layout(std430, set = 0, binding = 1) readonly buffer Geometry {
    vec2 geometry[];
};

struct Edge {
    vec2 a;
    vec2 b;
    uint run;
    uint run_count;
    float deviation;
    uint first_edge;
};

Edge edge_at(uint index) {
    vec2 run = geometry[index + 2u];
    vec2 rest = geometry[index + 3u];
    return Edge(geometry[index], geometry[index + 1u], floatBitsToUint(run.x),
                floatBitsToUint(run.y), rest.x, floatBitsToUint(rest.y));
}

// The edge at position i of a list.
Edge list_edge(EdgeList list, uint i) {
    return edge_at(list.edges + 4u * i);
}

// How far along a segment the point nearest to p lies: 0 at a, 1 at b.
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

float distance_to_box(vec2 p, vec2 low, vec2 high) {
    return length(max(max(low - p, p - high), vec2(0.0)));
}
