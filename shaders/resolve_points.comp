#version 450
#extension GL_GOOGLE_include_directive : require

// The nearest edge of B (section 2.2.4 of the paper), one thread per point of A's boundary. The
// images of the raster passes give the side of points away from the boundary and a first candidate
// for the nearest feature. The rest is decided on B's own edges.

#include "layout.glsl"
#include "push.h"
#include "nearest.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) readonly buffer Points {
    TilePointData points[];
};
layout(std430, set = 0, binding = 3) writeonly buffer Results {
    uint results[];
};
layout(set = 0, binding = 4) uniform usampler2D feature_image;
layout(set = 0, binding = 5) uniform usampler2D sign_image;

layout(push_constant) uniform Push { ResolvePointsPush push; };

uint resolve(TilePointData point) {
    TileData tile = tile_at(point.tile);
    vec2 p = point.position;
    ivec2 cell = clamp(ivec2(floor(p)), ivec2(0), ivec2(tile.width, tile.height) - 1);
    ivec2 texel = ivec2(tile.atlas_x, tile.atlas_y) + cell;
    uint feature = texelFetch(feature_image, texel, 0).x;

    Nearest nearest = nothing_near;
    bool settled = false;
    bool inside = texelFetch(sign_image, texel, 0).x != 0u;
    if (feature != no_feature) {
        EdgeData edge = list_edge(tile.nearest, feature);
        settled = distance_to_segment(vec2(cell) + 0.5, edge.a, edge.b) > tile.settled;
        if (settled && !inside && tile.outside == 0u) {
            return 0u;
        }
        consider_run(p, edge, nearest);
    }
    if (!settled) {
        inside = inside_by_crossings(p, tile.crossing);
    }
    if (!inside && tile.outside == 0u) {
        return 0u;
    }
    nearest = find_nearest(p, tile.nearest, nearest);
    uint unique = has_rival(p, tile.nearest, nearest, tile.margin) ? 0u : point_unique;
    return point_resolved | (inside ? point_inside : 0u) | unique | nearest.edge;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index < push.end) {
        results[index] = resolve(points[index]);
    }
}
