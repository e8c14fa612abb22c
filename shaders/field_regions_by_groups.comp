#version 450
#extension GL_GOOGLE_include_directive : require

// The same as field_regions.comp, one workgroup per region: it goes from level to level, and keeps the
// boxes that can have the nearest edge.

#include "fields.glsl"
#include "near_edges.glsl"
#include "near_groups.glsl"

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};

shared uint lists[2u * list_words];

uint boxes_of(Shape shape, uint level) {
    return (shape.chunks + (1u << (3u * level)) - 1u) >> (3u * level);
}

// The lowest level of which each thread has few boxes.
uint start_level(Shape shape) {
    uint level = shape.levels - 1u;
    while (level > 0u && boxes_of(shape, level - 1u) <= chunk_size * threads) {
        --level;
    }
    return level;
}

vec2 point_of(Square square, uint point) {
    return point == 0u ? square.centre
                       : vec2(square.corners_x[point - 1u], square.corners_y[point - 1u]);
}

// From a box to the chunk that seems the nearest to a point: a box of each level.
uint descend(Shape shape, uint level, uint box, vec2 point) {
    for (; level > 0u; --level) {
        Group group = group_of(shape, level - 1u, box);
        uint best = 0u;
        float least = infinity;
        for (uint i = 0u; i < chunk_size; ++i) {
            vec4 bounds = floats_at(group.first + min(i, group.count - 1u));
            vec2 way = way_from_box(point, bounds);
            vec2 from_middle = point - 0.5 * (bounds.xy + bounds.zw);
            float nearness = 16.0 * dot(way, way) + dot(from_middle, from_middle);
            best = nearness < least ? i : best;
            least = min(nearness, least);
        }
        box = chunk_size * box + best;
    }
    return box;
}

// Chooses a chunk for each point.
void choose_chunks(Square square, Shape shape, uint level) {
    uint first = word_at(shape.first_boxes + level);
    uint count = boxes_of(shape, level);
    Words nearest = no_words;
    for (uint i = gl_LocalInvocationID.x; i < count; i += threads) {
        nearest = least(nearest, nearness_of(square, floats_at(first + i), i));
    }
    nearest = places_of(least_of(nearest, 1u));
    uint point = gl_LocalInvocationID.x;
    if (point < point_count) {
        uint box = point == 0u ? nearest.centre : nearest.corners[point - 1u];
        chosen[point] = descend(shape, level, box, point_of(square, point));
    }
    barrier();
}

// Boxes of a level: `count` of them; the children of those in a list, or all.
struct Boxes {
    uint level;
    uint count;
    uint list;
    bool all;
};

uint number_of(Boxes boxes, uint i) {
    return boxes.all ? i : chunk_size * lists[boxes.list + i / chunk_size] + i % chunk_size;
}

// Makes a list of the boxes that can have the nearest edge; returns their number. Those beyond
// max_listed are missing.
uint list_boxes(Square square, Shape shape, Limits limits, Boxes boxes, uint list) {
    uint first_box = word_at(shape.first_boxes + boxes.level);
    uint end = boxes_of(shape, boxes.level);
    uint listed = 0u;
    for (uint base = 0u; base < boxes.count; base += elements_at_once) {
        uint run = run_of(boxes.count - base, 1u);
        uint first = base + gl_LocalInvocationID.x * run;
        uint near = 0u;
        for (uint i = 0u; i < run && first + i < boxes.count; ++i) {
            uint box = number_of(boxes, first + i);
            if (box < end && can_be_nearest(square, limits,
                                            way_from_box(square.centre, floats_at(first_box + box)))) {
                near |= 1u << i;
            }
        }
        uint total;
        uint place = listed + sum_before(bitCount(near), 1u, total);
        for (; near != 0u && place < max_listed; ++place) {
            lists[list + place] = number_of(boxes, first + take_bit(near));
        }
        listed += total;
    }
    barrier();
    return listed;
}

// Returns the number of chunks in a list, or crowded.
uint list_chunks(Square square, Shape shape, Limits limits, uint level, out uint list) {
    list = 0u;
    Boxes boxes = Boxes(level, boxes_of(shape, level), 0u, true);
    for (;;) {
        uint count = list_boxes(square, shape, limits, boxes, list);
        if (count > max_listed) {
            return crowded;
        }
        if (boxes.level == 0u) {
            return count;
        }
        boxes = Boxes(boxes.level - 1u, chunk_size * count, list, false);
        list = list_words - list;
    }
}

void main() {
    uint index = push.first + gl_WorkGroupID.x;
    FieldTileData tile = tile_at(tile_of(index, by_region));
    Shape shape = shape_at(tile.b.shape);
    Square square =
        square_at(tile, place_of(tile, index - tile.first_region, region_side), region_side);
    uint level = start_level(shape);
    choose_chunks(square, shape, level);
    Limits limits = limits_by_chosen(tile, shape, square);
    uint list;
    uint count = list_chunks(square, shape, limits, level, list);
    uint first = push.regions + words_of_region * index;
    if (gl_LocalInvocationID.x == 0u) {
        scratch[first] = count;
    }
    for (uint i = gl_LocalInvocationID.x; count != crowded && i < count; i += threads) {
        scratch[first + 1u + i] = lists[list + i];
    }
}
