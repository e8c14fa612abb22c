#version 450
#extension GL_GOOGLE_include_directive : require

// Signed distance at the centre of every cell of a tile (section 2.2.2 of the paper): analytic, to
// the feature that won the depth test here or at a neighbour; the sign comes from the fill.

#include "layout.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, set = 0, binding = 3) writeonly buffer Values {
    float values[];
};
layout(set = 0, binding = 4) uniform usampler2D feature_image;
layout(set = 0, binding = 5) uniform usampler2D sign_image;

layout(push_constant) uniform Push {
    uint tile;
    uint first;  // index of the tile's value at cell (0, 0)
} push;

void main() {
    Tile tile = tiles[push.tile];
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = ivec2(tile.width, tile.height) - 1;
    if (any(greaterThan(cell, last))) {
        return;
    }
    ivec2 corner = ivec2(tile.atlas_x, tile.atlas_y);
    vec2 centre = vec2(cell) + 0.5;

    // Neighbours give a second opinion where the flat triangles of a cone let the wrong feature win,
    // and mostly an answer where rasterisation left a sample out between two triangles.
    const ivec2 offsets[5] =
        ivec2[5](ivec2(0), ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));
    float nearest = 1.0 / 0.0;
    uint former = no_feature;
    for (int i = 0; i < 5; ++i) {
        ivec2 neighbour = clamp(cell + offsets[i], ivec2(0), last);
        uint feature = texelFetch(feature_image, corner + neighbour, 0).x;
        if (feature != no_feature && feature != former) {
            Edge edge = list_edge(tile.nearest, feature);
            nearest = min(nearest, distance_to_segment(centre, edge.a, edge.b));
            former = feature;
        }
    }
    if (isinf(nearest)) {
        for (uint i = 0u; i < tile.nearest.count; ++i) {
            Edge edge = list_edge(tile.nearest, i);
            nearest = min(nearest, distance_to_segment(centre, edge.a, edge.b));
        }
    }
    bool inside = texelFetch(sign_image, corner + cell, 0).x != 0u;
    values[push.first + uint(cell.y) * tile.width + uint(cell.x)] = inside ? -nearest : nearest;
}
