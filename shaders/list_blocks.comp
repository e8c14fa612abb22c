#version 450
#extension GL_GOOGLE_include_directive : require

// Lists by block the edges that can be nearest in it, one thread a block. Where there is no room for
// all, the number says so.
//
// The distance to an edge is a convex function: it lies above its tangent at the block's centre, and
// what it exceeds a linear function by is largest at a corner. So an edge whose tangent lies above
// the distance to the edge nearest to the centre, at all four corners, is nearest nowhere in the
// block.

#define BLOCKS_ACCESS
#include "layout.glsl"
#include "nearest.glsl"
#include "blocks.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint first;
    uint end;
    uint blocks;  // where they start in the geometry array
    uint lists;   // where their lists start in the scratch memory
} push;

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    Block block = block_at(push.blocks + index);
    Tile part = tiles[block.part];
    vec2 low = vec2(block.corner);
    vec2 high = min(low + float(block_side), vec2(part.width, part.height));
    vec2 centre = 0.5 * (low + high);

    float nearest = infinity;
    uint nearest_edge = 0u;
    for (uint first = 0u; first < part.nearest.count; first += cluster_size) {
        uint box = part.nearest.clusters + first / cluster_size * 2u;
        if (distance_to_box(centre, geometry[box], geometry[box + 1u]) > nearest) {
            continue;
        }
        uint end = min(first + cluster_size, part.nearest.count);
        for (uint i = first; i < end; ++i) {
            uint edge = part.nearest.edges + 4u * i;
            float d = distance_to_segment(centre, geometry[edge], geometry[edge + 1u]);
            if (d < nearest) {
                nearest = d;
                nearest_edge = edge;
            }
        }
    }

    // Of B's own edges, which features name, some are nearer than the edge that stands for them.
    float slack = (part.first_feature != not_asked ? 2.0 * part.settled : 0.02) +
                  4.0 * relative_margin * nearest;
    vec2 a = geometry[nearest_edge];
    vec2 b = geometry[nearest_edge + 1u];
    vec2 h = high - centre;
    // At the corners low left, low right, high left, high right.
    vec4 at_corners = vec4(distance_to_segment(centre - h, a, b),
                           distance_to_segment(centre + vec2(h.x, -h.y), a, b),
                           distance_to_segment(centre + vec2(-h.x, h.y), a, b),
                           distance_to_segment(high, a, b)) +
                      slack;
    float limit = max(max(at_corners.x, at_corners.y), max(at_corners.z, at_corners.w)) + length(h);
    uint list = push.lists + block_words * index;
    uint count = 0u;
    for (uint first = 0u; first < part.nearest.count; first += cluster_size) {
        uint box = part.nearest.clusters + first / cluster_size * 2u;
        if (distance_to_box(centre, geometry[box], geometry[box + 1u]) > limit) {
            continue;
        }
        uint end = min(first + cluster_size, part.nearest.count);
        for (uint i = first; i < end; ++i) {
            uint edge = part.nearest.edges + 4u * i;
            vec2 away = centre - nearest_on_segment(centre, geometry[edge], geometry[edge + 1u]);
            float d = length(away);
            vec2 slope = d > 0.0 ? away / d * h : vec2(0.0);
            vec4 tangent = d + vec4(-slope.x - slope.y, slope.x - slope.y, slope.y - slope.x,
                                    slope.x + slope.y);
            if (any(lessThanEqual(tangent, at_corners))) {
                if (count < block_capacity) {
                    scratch[list + 1u + count] = i;
                }
                ++count;
            }
        }
    }
    scratch[list] = count;
}
