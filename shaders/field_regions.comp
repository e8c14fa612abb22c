#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require

// The chunks of B's edges that can be nearest in a region of a field tile, one thread per region: a
// walk for the rivals, and one for the chunks that none of them rules out.

#include "fields.glsl"
#include "near_edges.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};

// Of each walk. Some drivers end the loops of an invocation after 65,535 turns, without notice; a step
// takes up to nine.
const uint max_steps = 3000u;

void consider_chunk(Square square, Shape shape, uint chunk, inout Rivals rivals) {
    uint end = edges_end(shape, chunk);
    for (uint slot = chunk_size * chunk; slot < end; ++slot) {
        consider(square, floats_at(shape.edges + slot), slot, rivals);
    }
}

// Follows the nearest box from level to level: a first bound.
void descend_to_nearest(Square square, Shape shape, inout Rivals rivals) {
    uint box = 0u;
    for (uint level = shape.levels; level > 0u; --level) {
        Group group = group_of(shape, level - 1u, box);
        uint best = 0u;
        float least = infinity;
        for (uint i = 0u; i < group.count; ++i) {
            float d = length(way_from_box(square.centre, floats_at(group.first + i)));
            best = d < least ? i : best;
            least = min(d, least);
        }
        box = chunk_size * box + best;
    }
    consider_chunk(square, shape, box, rivals);
}

// Whether a box can hold an edge nearer to the centre or to a corner than the rivals are.
bool has_rivals(Square square, Rivals rivals, vec4 box) {
    vec2 way = way_from_box(square.centre, box);
    vec4 x = square.corners_x - clamp(square.corners_x, vec4(box.x), vec4(box.z));
    vec4 y = square.corners_y - clamp(square.corners_y, vec4(box.y), vec4(box.w));
    return dot(way, way) < rivals.squared ||
           any(lessThan(x * x + y * y, rivals.corner_squared));
}

bool find_rivals(Square square, Shape shape, out Rivals rivals) {
    rivals = no_rivals;
    descend_to_nearest(square, shape, rivals);
    Walk walk = start_walk(shape);
    bool enters = true;
    for (uint step = 0u; step < max_steps; ++step) {
        if (enters) {
            Group group = group_of(shape, walk.level, walk.group);
            uint boxes = 0u;
            [[unroll]] for (uint i = 0u; i < chunk_size; ++i) {
                if (i < group.count && has_rivals(square, rivals, floats_at(group.first + i))) {
                    boxes |= 1u << i;
                }
            }
            add_boxes(walk, boxes);
        }
        uint box;
        if (!next_box(walk, box)) {
            return true;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
        } else if (has_rivals(square, rivals, floats_at(word_at(shape.first_boxes) + box))) {
            consider_chunk(square, shape, box, rivals);
        }
    }
    return false;
}

// Returns their number, or crowded.
uint list_chunks(Square square, Shape shape, Limits limits, uint list) {
    uint count = 0u;
    Walk walk = start_walk(shape);
    bool enters = true;
    for (uint step = 0u; step < 4u * max_steps; ++step) {
        if (enters) {
            Group group = group_of(shape, walk.level, walk.group);
            uint boxes = 0u;
            [[unroll]] for (uint i = 0u; i < chunk_size; ++i) {
                if (i < group.count &&
                    can_be_nearest(square, limits,
                                   way_from_box(square.centre, floats_at(group.first + i)))) {
                    boxes |= 1u << i;
                }
            }
            add_boxes(walk, boxes);
        }
        uint box;
        if (!next_box(walk, box)) {
            return count;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
            continue;
        }
        if (++count == words_of_region) {
            return crowded;
        }
        scratch[list + count] = box;
    }
    return crowded;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    FieldTileData tile = tile_at(tile_of(index, by_region));
    Shape shape = shape_at(tile.b.shape);
    Square square =
        square_at(tile, place_of(tile, index - tile.first_region, region_side), region_side);
    uint list = push.regions + words_of_region * index;
    Rivals rivals;
    uint count = crowded;
    if (find_rivals(square, shape, rivals)) {
        Limits limits = limits_of(tile, shape, square, rivals.slot, rivals.corner_slot);
        count = list_chunks(square, shape, limits, list);
    }
    scratch[list] = count;
}
