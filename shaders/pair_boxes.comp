#version 450
#extension GL_GOOGLE_include_directive : require

// The first step towards pairs, one thread per instance, in the order of the hierarchy: its box in
// the world, relative to the origin, and the boxes of the next two levels.

#include "search.glsl"
#include "pairs.glsl"

layout(local_size_x = group_size) in;

shared vec4 boxes[group_size];

// The most edges, or boxes of one level, of a shape that a thread looks at.
const uint few_boxes = 64u;
const float rounding = 1.0 / 1048576.0;  // of a handful of operations

vec4 box_of_vertices(Shape shape, mat2 frame) {
    vec4 box = empty_box;
    for (uint chunk = 0u; chunk < shape.chunks; ++chunk) {
        uint end = edges_end(shape, chunk);
        uint slot = chunk_size * chunk;
        vec2 next = floats_at(shape.edges + slot).xy;
        for (; slot < end; ++slot) {
            vec2 vertex = frame * next;
            next = floats_at(shape.edges + slot + 1u).xy;
            box = merged(box, vertex.xyxy);
        }
    }
    return box;
}

vec4 box_of_boxes(Shape shape, mat2 frame) {
    uint level = 0u;
    uint count = shape.chunks;
    while (count > few_boxes) {
        count = (count + chunk_size - 1u) / chunk_size;
        ++level;
    }
    uint first = word_at(shape.first_boxes + level);
    vec4 box = empty_box;
    for (uint i = 0u; i < count; ++i) {
        box = merged(box, turned_box(floats_at(first + i), frame, vec2(0.0), 0.0));
    }
    return box;
}

vec4 box_of(SearchInstanceData instance) {
    Shape shape = shape_at(instance.shape);
    mat2 frame = instance.unit *
                 mat2(instance.axis.x, instance.axis.y, -instance.axis.y, instance.axis.x);
    vec4 box = chunk_size * shape.chunks <= few_boxes ? box_of_vertices(shape, frame)
                                              : box_of_boxes(shape, frame);
    // Half the reach on either side; the sum rounds once more.
    float grow = rounding * (instance.radius + abs(instance.high.x) + abs(instance.high.y)) +
                 2.0 * instance.box_rounding + (0.5 + rounding) * pair_query().reach;
    return box + instance.high.xyxy + vec4(-grow, -grow, grow, grow);
}

// Of the boxes that are `step` apart, grows every eighth one to hold the seven that follow it.
void merge_boxes(uint step) {
    uint own = gl_LocalInvocationID.x;
    barrier();
    if (own % (8u * step) == 0u) {
        for (uint i = 1u; i < 8u; ++i) {
            boxes[own] = merged(boxes[own], boxes[own + step * i]);
        }
    }
}

void main() {
    uint place = push.first + dispatched_index();
    uint own = gl_LocalInvocationID.x;
    bool exists = place < push.instances;
    boxes[own] = empty_box;
    if (exists) {
        uint number = instance_in_order(place);
        SearchInstanceData instance = instance_at(number);
        boxes[own] = box_of(instance);
        scratch_units[level_unit(0u) + place] = floatBitsToUint(boxes[own]);
        scratch_units[place_unit(place)] = uvec4(number, instance.category, instance.mask, 0u);
    }
    merge_boxes(1u);
    if (exists && own % 8u == 0u) {
        scratch_units[level_unit(1u) + place / 8u] = floatBitsToUint(boxes[own]);
    }
    merge_boxes(8u);
    if (own == 0u) {
        scratch_units[level_unit(2u) + place / 64u] = floatBitsToUint(boxes[own]);
    }
}
