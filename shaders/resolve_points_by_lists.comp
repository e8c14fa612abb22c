#version 450
#extension GL_GOOGLE_include_directive : require

// The nearest edge of B (section 2.2.4 of the paper) from the lists of edges alone, one thread a
// point of A's boundary: resolve_points.comp without images.

#include "layout.glsl"
#include "nearest.glsl"

layout(local_size_x = 64) in;

struct Point {
    vec2 position;
    uint tile;
    uint cell;  // of a field only
};

layout(std430, set = 0, binding = 2) readonly buffer Points {
    Point points[];
};
layout(std430, set = 0, binding = 3) writeonly buffer Results {
    uint results[];
};

layout(push_constant) uniform Push {
    uint first;
    uint count;
    uint details;  // where those of the points start in the results; no_details
} push;

#include "details.glsl"

uint resolve(uint index, Point point) {
    Tile tile = tiles[point.tile];
    bool inside = inside_by_crossings(point.position, tile.crossing);
    if (!inside && tile.outside == 0u) {
        return 0u;
    }
    Nearest nearest = find_nearest(point.position, tile.nearest, nothing_near);
    write_details(index, point.position, nearest, tile.crossing);
    uint unique =
        has_rival(point.position, tile.nearest, nearest, tile.margin) ? 0u : unique_flag;
    return resolved_flag | (inside ? inside_flag : 0u) | unique | nearest.edge;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index < push.count) {
        results[index] = resolve(index, points[index]);
    }
}
