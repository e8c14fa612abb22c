#version 450
#extension GL_GOOGLE_include_directive : require

// Whether two shapes' boundaries meet or, in a test, are within reach, one thread per edge of A that
// comes near B. Ends where another edge of the same pair is known to be.

#include "search.glsl"
#include "pairs.h"
#include "crossings.glsl"

layout(local_size_x = group_size) in;

Limits limits_of(SearchDirectionData direction) {
    // The reach of contacts is not that of the boundaries.
    float reach = direction.outside != 0.0 ? direction.margin : direction.reach;
    return Limits(reach - 4.0 * direction.margin, reach + 2.0 * direction.margin,
                  3.0 * direction.margin);
}

// The boxes of a walk's group that overlap with a box.
void enter(inout Walk walk, Shape b, vec4 own) {
    Group group = group_of(b, walk.level, walk.group);
    uint boxes = 0u;
    vec4 next = floats_at(group.first);
    for (uint i = 0u; i < group.count; ++i) {
        vec4 box = next;
        next = floats_at(group.first + i + 1u);
        boxes |= do_overlap(box, own) ? 1u << i : 0u;
    }
    add_boxes(walk, boxes);
}

uint verdict_of(uint direction_index, uint edge_slot) {
    SearchDirectionData direction = direction_at(direction_index);
    Shape b = shape_at(direction.shape_b);
    vec4 edge = floats_at(shape_at(direction.shape_a).edges + edge_slot);
    vec2 from = placed(direction, edge.xy);
    vec2 to = placed(direction, edge.zw);
    Limits limits = limits_of(direction);
    vec4 own = vec4(min(from, to) - limits.far, max(from, to) + limits.far);
    uint verdict = 0u;
    Walk walk = start_walk(b);
    for (uint steps = 0u; steps < max_steps && (verdict & pair_meets) == 0u; ++steps) {
        enter(walk, b, own);
        uint chunks = take_chunks(walk);
        steps += bitCount(chunks);
        while (chunks != 0u) {
            uint chunk = chunk_size * walk.group + take_bit(chunks);
            uint end = edges_end(b, chunk);
            uint slot = chunk_size * chunk;
            vec4 next = floats_at(b.edges + slot);
            for (; slot < end; ++slot) {
                vec4 other = next;
                next = floats_at(b.edges + slot + 1u);
                verdict |= verdict_on(from, to, other, limits);
            }
        }
        uint box;
        if (!next_box(walk, box)) {
            return verdict;
        }
        descend(walk, box);
    }
    return verdict | pair_in_doubt;
}

void main() {
    uint index = dispatched_index();
    if (index >= scratch[edge_total]) {
        return;
    }
    uvec2 edge = scratch_unit(push.edge_units + units_of_edge * index).xy;  // direction and slot
    uint word = push.verdicts + edge.x;
    if ((atomicOr(scratch[word], 0u) & (pair_meets | pair_left_to_cpu)) != 0u) {
        return;
    }
    uint verdict = verdict_of(edge.x, edge.y);
    if (verdict != 0u) {
        atomicOr(scratch[word], verdict);
    }
}
