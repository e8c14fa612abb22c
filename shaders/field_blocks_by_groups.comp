#version 450
#extension GL_GOOGLE_include_directive : require

// The same as field_quarters.comp and field_blocks.comp, one workgroup per quarter: the edges near it
// from the chunks near its region, and of these the segments for each of its blocks.

#include "fields.glsl"
#include "near_edges.glsl"
#include "near_groups.glsl"

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

shared uint edge_list[list_words];
shared uint near_lists[blocks * max_near];  // of chunks at first, then of the edges near each block
shared uint near_counts[blocks];
shared uint first_segment;

// A list of the chunks near the region: its first word, and their number.
struct Chunks {
    uint first;
    uint count;
};

void choose_chunks(Square square, Shape shape, Chunks chunks) {
    uint first_box = word_at(shape.first_boxes);
    Words nearest = no_words;
    for (uint i = gl_LocalInvocationID.x; i < chunks.count; i += threads) {
        vec4 box = floats_at(first_box + scratch[chunks.first + i]);
        nearest = least(nearest, nearness_of(square, box, i));
    }
    nearest = places_of(least_of(nearest, 1u));
    uint point = gl_LocalInvocationID.x;
    if (point < point_count) {
        uint place = point == 0u ? nearest.centre : nearest.corners[point - 1u];
        chosen[point] = scratch[chunks.first + place];
    }
    barrier();
}

// Lists the chunks that can have the nearest edge; returns their number. A region lists fewer than the
// threads take at once.
uint list_chunks(Square square, Shape shape, Limits limits, Chunks chunks) {
    uint first_box = word_at(shape.first_boxes);
    uint run = run_of(chunks.count, 1u);
    uint first = gl_LocalInvocationID.x * run;
    uint near = 0u;
    for (uint i = 0u; i < run && first + i < chunks.count; ++i) {
        vec4 box = floats_at(first_box + scratch[chunks.first + first + i]);
        near |= can_be_nearest(square, limits, way_from_box(square.centre, box)) ? 1u << i : 0u;
    }
    uint total;
    uint place = sum_before(bitCount(near), 1u, total);
    for (; near != 0u; ++place) {
        near_lists[place] = scratch[chunks.first + first + take_bit(near)];
    }
    barrier();
    return total;
}

uint slot_at(uint i) {
    return chunk_size * near_lists[i / chunk_size] + i % chunk_size;
}

// Lists the edges of the listed chunks that can be nearest; returns their number. Those beyond
// max_listed are missing.
uint list_edges(Square square, Shape shape, Limits limits, uint count) {
    uint listed = 0u;
    for (uint base = 0u; base < count; base += elements_at_once) {
        uint run = run_of(count - base, 1u);
        uint first = base + gl_LocalInvocationID.x * run;
        uint near = 0u;
        for (uint i = 0u; i < run && first + i < count; ++i) {
            uint slot = slot_at(first + i);
            if (slot < edges_end(shape, slot / chunk_size) &&
                can_be_nearest(square, limits,
                               way_from_edge(square.centre, floats_at(shape.edges + slot)))) {
                near |= 1u << i;
            }
        }
        uint total;
        uint place = listed + sum_before(bitCount(near), 1u, total);
        for (; near != 0u && place < max_listed; ++place) {
            edge_list[place] = slot_at(first + take_bit(near));
        }
        listed += total;
    }
    barrier();
    return listed;
}

uint list_edges_of_quarter(FieldTileData tile, Shape shape, uvec2 place, Chunks chunks) {
    Square square = square_at(tile, place, quarter_side);
    choose_chunks(square, shape, chunks);
    Limits limits = limits_by_chosen(tile, shape, square);
    uint count = list_chunks(square, shape, limits, chunks);
    return list_edges(square, shape, limits, chunk_size * count);
}

// The limits of the block of this thread's row.
Limits find_limits(FieldTileData tile, Shape shape, Square square, uint edge_count) {
    Words nearest = no_words;
    for (uint i = gl_LocalInvocationID.x / blocks; i < edge_count; i += threads / blocks) {
        nearest = least(nearest, nearness_of_edge(square, floats_at(shape.edges + edge_list[i]), i));
    }
    nearest = places_of(least_of(nearest, blocks));
    uvec4 corners = nearest.corners;
    return limits_of(tile, shape, square, edge_list[nearest.centre],
                     uvec4(edge_list[corners.x], edge_list[corners.y], edge_list[corners.z],
                           edge_list[corners.w]));
}

// Lists the edges that can be nearest in the block of this thread's row; returns their number. Those
// beyond max_near are missing.
uint list_near(FieldTileData tile, Shape shape, uvec2 place, uint edge_count) {
    Square square = square_at(tile, place, block_side);
    Limits limits;
    bool culls = edge_count > few_edges;
    if (culls) {
        limits = find_limits(tile, shape, square, edge_count);
    }
    uint list = gl_LocalInvocationID.x % blocks * max_near;
    uint listed = 0u;
    for (uint base = 0u; base < edge_count; base += elements_at_once / blocks) {
        uint run = run_of(edge_count - base, blocks);
        uint first = base + gl_LocalInvocationID.x / blocks * run;
        uint near = 0u;
        for (uint i = 0u; i < run && first + i < edge_count; ++i) {
            vec4 edge = floats_at(shape.edges + edge_list[first + i]);
            if (!culls || can_be_nearest(square, limits, way_from_edge(square.centre, edge))) {
                near |= 1u << i;
            }
        }
        uint total;
        uint at = listed + sum_before(bitCount(near), blocks, total);
        for (; near != 0u && at < max_near; ++at) {
            near_lists[list + at] = edge_list[first + take_bit(near)];
        }
        listed += total;
    }
    return listed;
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
        uint slot = near_lists[max_near * block + i + near_counts[block] - ends[block]];
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
    Chunks chunks = Chunks(list + 1u, scratch[list]);
    uint count = crowded;
    if (chunks.count != crowded) {
        count = list_edges_of_quarter(tile, shape, place, chunks);
    }
    uint block = gl_LocalInvocationID.x % blocks;
    uvec2 place_of_block = 2u * place + offset_of(block);
    if (count <= max_listed) {
        count = list_near(tile, shape, place_of_block, count);
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
