#version 450
#extension GL_GOOGLE_include_directive : require

// The same as field_regions.comp, one workgroup per region: it goes from level to level, and keeps the
// boxes that can have the nearest edge.

#include "fields.glsl"
#include "near_edges.glsl"

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};

shared uint lists[2u * words_of_region];

#include "near_groups.glsl"

// The lowest level of which each thread has few boxes.
uint start_level(Shape shape) {
    uint level = shape.levels - 1u;
    while (level > 0u && boxes_of(shape, level - 1u) <= chunk_size * threads) {
        --level;
    }
    return level;
}

// Returns the number of chunks in a list, or crowded.
uint list_chunks(Square square, Shape shape, Limits limits, Elements boxes, out uint list) {
    list = 0u;
    for (;;) {
        uint count = list_near(square, shape, limits, boxes, 1u, list, max_listed);
        if (count > max_listed) {
            return crowded;
        }
        if (boxes.level == 0u) {
            return count;
        }
        boxes = Elements(false, boxes.level - 1u, chunk_size * count, from_parents, list);
        list = words_of_region - list;
    }
}

void main() {
    uint index = push.first + gl_WorkGroupID.x;
    FieldTileData tile = tile_at(tile_of(index, by_region));
    Shape shape = shape_at(tile.b.shape);
    Square square =
        square_at(tile, place_of(tile, index - tile.first_region, region_side), region_side);
    uint level = start_level(shape);
    Elements boxes = Elements(false, level, boxes_of(shape, level), from_all, 0u);
    choose_chunks(square, shape, boxes);
    Limits limits = limits_by_chosen(tile, shape, square);
    uint list;
    uint count = list_chunks(square, shape, limits, boxes, list);
    uint first = push.regions + words_of_region * index;
    if (gl_LocalInvocationID.x == 0u) {
        scratch[first] = count;
    }
    for (uint i = gl_LocalInvocationID.x; count != crowded && i < count; i += threads) {
        scratch[first + 1u + i] = lists[list + i];
    }
}
