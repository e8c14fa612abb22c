#version 450
#extension GL_GOOGLE_include_directive : require

// The same as field_quarters.comp and field_blocks.comp, one workgroup per quarter: the edges near it
// from the chunks near its region, and of these the segments for each of its blocks.

#include "fields.glsl"
#include "near_edges.glsl"

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 1) buffer ScratchUnits {
    uvec4 scratch_units[];  // the same memory
};
layout(std430, set = 0, binding = 2) buffer Crowd {
    uint crowd;  // the number of crowded blocks
};

const uint blocks = 4u;  // of a quarter; each has a row of threads
const uint max_near = 256u;

// A list of the edges near the quarter, and behind it those of each block; before these, of the chunks
// near the quarter.
const uint list_of_edges = 0u;
const uint list_of_blocks = words_of_region;
shared uint lists[list_of_blocks + blocks * max_near];
shared uint near_counts[blocks];
shared uint first_segment;

#include "near_groups.glsl"

// Lists the edges near the quarter; returns their number.
uint list_edges(FieldTileData tile, Shape shape, uvec2 place, Elements chunks) {
    Square square = square_at(tile, place, quarter_side);
    choose_chunks(square, shape, chunks);
    Limits limits = limits_by_chosen(tile, shape, square);
    uint count = list_near(square, shape, limits, chunks, 1u, list_of_blocks, max_listed);
    Elements edges = Elements(true, 0u, chunk_size * count, from_parents, list_of_blocks);
    return list_near(square, shape, limits, edges, 1u, list_of_edges, max_listed);
}

// The limits of the block of this thread's row: there are none where all edges count.
Limits find_limits(FieldTileData tile, Shape shape, Square square, Elements edges) {
    if (edges.count <= few_edges) {
        const vec4 none = vec4(infinity);
        return Limits(none, none, none, none, none);
    }
    Words nearest = no_words;
    for (uint i = gl_LocalInvocationID.x / blocks; i < edges.count; i += threads / blocks) {
        vec4 edge = floats_at(shape.edges + element_at(edges, i));
        nearest = least(nearest, nearness_of_edge(square, edge, i));
    }
    nearest = places_of(least_of(nearest, blocks));
    uvec4 corners = nearest.corners;
    return limits_of(tile, shape, square, element_at(edges, nearest.centre),
                     uvec4(element_at(edges, corners.x), element_at(edges, corners.y),
                           element_at(edges, corners.z), element_at(edges, corners.w)));
}

// Lists the edges that can be nearest in the block of this thread's row; returns their number.
uint list_near_block(FieldTileData tile, Shape shape, uvec2 place, uint edge_count) {
    Square square = square_at(tile, place, block_side);
    Elements edges = Elements(true, 0u, edge_count, from_list, list_of_edges);
    Limits limits = find_limits(tile, shape, square, edges);
    uint list = list_of_blocks + gl_LocalInvocationID.x % blocks * max_near;
    return list_near(square, shape, limits, edges, blocks, list, max_near);
}

uvec2 offset_of(uint block) {
    return uvec2(block & 1u, block >> 1);
}

// Where the segments of each block end, among those of all.
uvec4 ends_of_blocks() {
    uvec4 ends = uvec4(near_counts[0], near_counts[1], near_counts[2], near_counts[3]);
    ends.yw += ends.xz;
    ends.zw += ends.y;
    return ends;
}

void write_segments(FieldTileData tile, Shape shape, uvec2 place, uvec4 ends) {
    for (uint i = gl_LocalInvocationID.x; i < ends.w; i += threads) {
        uint block = (i >= ends.x ? 1u : 0u) + (i >= ends.y ? 1u : 0u) + (i >= ends.z ? 1u : 0u);
        uint slot = lists[list_of_blocks + max_near * block + i + near_counts[block] - ends[block]];
        vec2 low = vec2((2u * place + offset_of(block)) * block_side);
        vec2 half_size = 0.5 * min(vec2(unpacked(tile.b.size)) - low, vec2(block_side));
        scratch_units[push.segments + first_segment + i] =
            segment_of(edge_seen_from(tile.b, shape, slot, low + half_size), half_size);
        if (tile.first_feature != not_asked) {
            scratch[push.numbers + first_segment + i] = number_of(shape, slot);
        }
    }
}

// Notes where the segments of the block of this thread's row are, or that it is crowded.
void write_block(FieldTileData tile, uvec2 place, bool fits, uvec4 ends) {
    uint block = gl_LocalInvocationID.x;
    uvec2 across = count_along(tile, block_side);
    if (block < blocks && all(lessThan(place, across))) {
        uint number = tile.first_block + place.y * across.x + place.x;
        uint count = near_counts[block];
        scratch[push.blocks + 2u * number] = first_segment + ends[block] - count;
        scratch[push.blocks + 2u * number + 1u] = fits ? count : crowded;
        if (!fits) {
            scratch[push.crowd + atomicAdd(crowd, 1u)] = number;
        }
    }
}

void main() {
    uint index = push.first + gl_WorkGroupID.x;
    FieldTileData tile = tile_at(tile_of(index, by_quarter));
    Shape shape = shape_at(tile.b.shape);
    uvec2 place = place_of(tile, index - tile.first_quarter, quarter_side);
    uint region = tile.first_region + place.y / 2u * count_along(tile, region_side).x + place.x / 2u;
    uint list = push.regions + words_of_region * region;
    uint count = scratch[list];
    if (count != crowded) {
        count = list_edges(tile, shape, place, Elements(false, 0u, count, from_region, list + 1u));
    }
    uint block = gl_LocalInvocationID.x % blocks;
    uvec2 place_of_block = 2u * place + offset_of(block);
    if (count <= max_listed) {
        count = list_near_block(tile, shape, place_of_block, count);
    }
    bool fits = count <= max_near;
    bool exists = all(lessThan(place_of_block, count_along(tile, block_side)));
    if (gl_LocalInvocationID.x < blocks) {
        near_counts[block] = exists && fits ? count : 0u;
    }
    barrier();
    uvec4 ends = ends_of_blocks();
    // The order in which quarters come to this line is of no consequence.
    if (gl_LocalInvocationID.x == 0u) {
        first_segment = atomicAdd(scratch[push.crowd - 1u], ends.w);
    }
    barrier();
    bool has_room = first_segment + ends.w <= push.room;
    write_block(tile, place_of_block, fits && has_room, ends);
    if (has_room) {
        write_segments(tile, shape, place, ends);
    }
}
