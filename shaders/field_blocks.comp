#version 450
#extension GL_GOOGLE_include_directive : require

// The segments that can be nearest in a block of a field tile, one thread per block: of the edges in
// the list of its quarter. Crowded blocks are noted.

#include "fields.glsl"
#include "near_edges.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 1) buffer ScratchUnits {
    uvec4 scratch_units[];  // the same memory
};
layout(std430, set = 0, binding = 2) buffer Crowd {
    uint crowd;  // the number of crowded blocks
};

// Four of `count` edges in a list, the last one in place of those beyond it.
uvec4 four_slots(uint first, uint i, uint count) {
    uvec4 words = first + min(i + uvec4(0u, 1u, 2u, 3u), uvec4(count - 1u));
    return uvec4(scratch[words.x], scratch[words.y], scratch[words.z], scratch[words.w]);
}

// Which of up to 32 of the quarter's edges, from one on, can be nearest: one bit each.
uint near_edges(Shape shape, Square square, Limits limits, uint first, uint count) {
    uint near = 0u;
    for (uint i = 0u; i < count; i += 4u) {
        near |= those_nearest(square, shape, limits, four_slots(first, i, count)) << i;
    }
    return near & ((2u << (count - 1u)) - 1u);
}

Limits find_limits(FieldTileData tile, Shape shape, Square square, uint edges, uint edge_count) {
    Rivals rivals = no_rivals;
    for (uint i = 0u; i < edge_count; i += 4u) {
        consider_four(square, shape, four_slots(edges, i, edge_count), rivals);
    }
    return limits_of(tile, shape, square, rivals.slot, rivals.corner_slot);
}

// Writes the segments if there is room, and where they are; returns whether there was. `edges`: the
// first word of the quarter's edges.
bool list_segments(FieldTileData tile, Shape shape, uvec2 place, uint edges, uint edge_count,
                   uint block) {
    Square square = square_at(tile, place, block_side);
    Limits limits;
    uint count = edge_count;
    uvec4 near = uvec4((1u << min(edge_count, few_edges)) - 1u, 0u, 0u, 0u);  // of the first 128 edges
    if (edge_count > few_edges) {
        limits = find_limits(tile, shape, square, edges, edge_count);
        count = 0u;
        for (uint i = 0u; i < edge_count; i += 32u) {
            uint some = near_edges(shape, square, limits, edges + i, min(edge_count - i, 32u));
            count += bitCount(some);
            near = mix(near, uvec4(some), equal(uvec4(i / 32u), uvec4(0u, 1u, 2u, 3u)));
        }
    }
    // The order in which blocks come to this line is of no consequence.
    uint next = atomicAdd(scratch[push.crowd - 1u], count);
    if (next + count > push.room) {
        return false;
    }
    scratch[push.blocks + 2u * block] = next;
    scratch[push.blocks + 2u * block + 1u] = count;
    vec2 low = vec2(place * block_side);
    vec2 half_size = 0.5 * min(vec2(unpacked(tile.b.size)) - low, vec2(block_side));
    for (uint i = 0u; i < edge_count; i += 32u) {
        uint some = i < 128u ? near[i / 32u]
                             : near_edges(shape, square, limits, edges + i,
                                          min(edge_count - i, 32u));
        for (; some != 0u; some &= some - 1u) {
            uint slot = scratch[edges + i + findLSB(some)];
            scratch_units[push.segments + next] =
                segment_of(edge_seen_from(tile.b, shape, slot, low + half_size), half_size);
            if (tile.first_feature != not_asked) {
                scratch[push.numbers + next] = number_of(shape, slot);
            }
            ++next;
        }
    }
    return true;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    FieldTileData tile = tile_at(tile_of(index, by_block));
    Shape shape = shape_at(tile.b.shape);
    uvec2 place = place_of(tile, index - tile.first_block, block_side);
    uint quarter =
        tile.first_quarter + place.y / 2u * count_along(tile, quarter_side).x + place.x / 2u;
    uint edges = push.quarters + words_of_quarter * quarter;
    uint count = scratch[edges];
    if (count == crowded || !list_segments(tile, shape, place, edges + 1u, count, index)) {
        scratch[push.blocks + 2u * index + 1u] = crowded;
        scratch[push.crowd + atomicAdd(crowd, 1u)] = index;
    }
}
