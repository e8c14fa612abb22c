#version 450
#extension GL_GOOGLE_include_directive : require

// The nearest edge of B (section 2.2.4 of the paper), one thread per point of A's boundary: as
// resolve_points.comp, but from edge lists alone.

#include "layout.glsl"
#include "push.h"
#include "nearest.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) readonly buffer Points {
    uvec4 points[];  // position, tile, a word used only by fields
};
layout(std430, set = 0, binding = 3) writeonly buffer Results {
    uint results[];
};

layout(push_constant) uniform Push { ResolvePointsPush push; };

#include "details.glsl"

uint resolve(uint index, vec2 p, TileData tile) {
    bool inside = inside_by_crossings(p, tile.crossing);
    if (!inside && tile.outside == 0u) {
        return 0u;
    }
    Nearest nearest = find_nearest(p, tile.nearest, nothing_near);
    write_details(index, p, nearest, tile);
    uint unique =
        has_rival(p, tile.nearest, nearest, tile.margin) ? 0u : point_unique;
    return point_resolved | (inside ? point_inside : 0u) | unique | nearest.edge;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index < push.end) {
        uvec4 point = points[index];
        results[index] = resolve(index, uintBitsToFloat(point.xy), tile_at(point.z));
    }
}
