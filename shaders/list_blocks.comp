#version 450
#extension GL_GOOGLE_include_directive : require

// Lists by block the edges that can be nearest in it, one thread a block: those no farther from its
// centre than the nearest one plus the block's diagonal. Where there is no room for all, the number
// says so.

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
    for (uint first = 0u; first < part.nearest.count; first += cluster_size) {
        uint box = part.nearest.clusters + first / cluster_size * 2u;
        if (distance_to_box(centre, geometry[box], geometry[box + 1u]) > nearest) {
            continue;
        }
        uint end = min(first + cluster_size, part.nearest.count);
        for (uint i = first; i < end; ++i) {
            uint edge = part.nearest.edges + 4u * i;
            nearest = min(nearest, distance_to_segment(centre, geometry[edge], geometry[edge + 1u]));
        }
    }

    // Of B's own edges, which features name, some are nearer than the edge that stands for them.
    float slack = part.first_feature != not_asked ? 2.0 * part.settled : 0.02;
    float limit = nearest + 4.0 * relative_margin * nearest + distance(low, high) + slack;
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
            if (distance_to_segment(centre, geometry[edge], geometry[edge + 1u]) <= limit) {
                if (count < block_capacity) {
                    scratch[list + 1u + count] = i;
                }
                ++count;
            }
        }
    }
    scratch[list] = count;
}
