#version 450
#extension GL_GOOGLE_include_directive : require

// The edges that can be nearest in a quarter of a region of a field tile, one thread per quarter: of
// the chunks in the region's list.

#include "fields.glsl"
#include "near_edges.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};

void consider_chunk(Square square, Shape shape, uint chunk, inout Rivals rivals) {
    uint first = chunk_size * chunk;
    uint last = edges_end(shape, chunk) - 1u;
    for (uint i = 0u; i < chunk_size; i += 4u) {
        uvec4 slots = first + i + uvec4(0u, 1u, 2u, 3u);
        consider_four(square, shape, min(slots, uvec4(last)), rivals);
    }
}

Rivals find_rivals(Square square, Shape shape, uint list, uint count) {
    Rivals rivals = no_rivals;
    for (uint i = 1u; i <= count; ++i) {
        uint chunk = scratch[list + i];
        vec4 box = floats_at(word_at(shape.first_boxes) + chunk);
        vec4 x = square.corners_x - clamp(square.corners_x, vec4(box.x), vec4(box.z));
        vec4 y = square.corners_y - clamp(square.corners_y, vec4(box.y), vec4(box.w));
        vec2 way = way_from_box(square.centre, box);
        if (dot(way, way) < rivals.squared ||
            any(lessThan(x * x + y * y, rivals.corner_squared))) {
            consider_chunk(square, shape, chunk, rivals);
        }
    }
    return rivals;
}

// Returns the number of edges, or crowded.
uint list_edges(Square square, Shape shape, Limits limits, uint chunks, uint chunk_count, uint list) {
    uint count = 0u;
    for (uint i = 1u; i <= chunk_count; ++i) {
        uint chunk = scratch[chunks + i];
        vec4 box = floats_at(word_at(shape.first_boxes) + chunk);
        if (!can_be_nearest(square, limits, way_from_box(square.centre, box))) {
            continue;
        }
        uint first = chunk_size * chunk;
        uint last = edges_end(shape, chunk) - 1u;
        uint near = 0u;
        for (uint four = 0u; four < chunk_size; four += 4u) {
            uvec4 slots = first + four + uvec4(0u, 1u, 2u, 3u);
            near |= those_nearest(square, shape, limits, min(slots, uvec4(last))) << four;
        }
        near &= (2u << (last - first)) - 1u;
        if (count + bitCount(near) >= words_of_quarter) {
            return crowded;
        }
        for (; near != 0u; near &= near - 1u) {
            scratch[list + ++count] = first + findLSB(near);
        }
    }
    return count;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    FieldTileData tile = tile_at(tile_of(index, by_quarter));
    Shape shape = shape_at(tile.b.shape);
    uvec2 place = place_of(tile, index - tile.first_quarter, quarter_side);
    Square square = square_at(tile, place, quarter_side);
    uint region = tile.first_region + place.y / 2u * count_along(tile, region_side).x + place.x / 2u;
    uint chunks = push.regions + words_of_region * region;
    uint chunk_count = scratch[chunks];
    uint list = push.quarters + words_of_quarter * index;
    uint count = crowded;
    if (chunk_count != crowded) {
        Rivals rivals = find_rivals(square, shape, chunks, chunk_count);
        Limits limits = limits_of(tile, shape, square, rivals.slot, rivals.corner_slot);
        count = list_edges(square, shape, limits, chunks, chunk_count, list);
    }
    scratch[list] = count;
}
