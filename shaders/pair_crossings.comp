#version 450
#extension GL_GOOGLE_include_directive : require

// Whether two shapes' boundaries meet, one thread per edge of A that comes near B. Ends where
// another edge of the same pair is known to meet B.

#include "search.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

float cross_product(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// Whether both ends of a segment are on the same side of another's line, or on opposite ones, and
// farther from it than the margin. `areas`: twice those of the triangles of the other with each end.
// `limit`: the margin times a length that is not below the other's.
bool are_on_one_side(vec2 areas, float limit) {
    return min(areas.x, areas.y) > limit || max(areas.x, areas.y) < -limit;
}

bool are_on_two_sides(vec2 areas, float limit) {
    return min(areas.x, areas.y) < -limit && max(areas.x, areas.y) > limit;
}

// Of the segments from `a` to `b` and along `edge`, whose ends are known to a part of `margin`.
uint verdict_on(vec2 a, vec2 b, vec4 edge, float margin) {
    vec2 along = b - a;
    vec2 other = edge.zw - edge.xy;
    // The sum of the components does not vanish where their squares would.
    float limit = margin * (abs(along.x) + abs(along.y));
    float limit_of_other = margin * (abs(other.x) + abs(other.y));
    vec2 ends = vec2(cross_product(along, edge.xy - a), cross_product(along, edge.zw - a));
    vec2 own_ends = vec2(cross_product(other, a - edge.xy), cross_product(other, b - edge.xy));
    vec2 gap = max(min(a, b), min(edge.xy, edge.zw)) - min(max(a, b), max(edge.xy, edge.zw));
    if (max(gap.x, gap.y) > margin || are_on_one_side(ends, limit) ||
        are_on_one_side(own_ends, limit_of_other)) {
        return 0u;
    }
    bool meet = are_on_two_sides(ends, limit) && are_on_two_sides(own_ends, limit_of_other);
    return meet ? pair_meets : pair_in_doubt;
}

// The boxes of a walk's group that overlap with a box.
void enter(inout Walk walk, Shape b, vec4 own) {
    Group group = group_of(b, walk.level, walk.group);
    uint boxes = 0u;
    for (uint i = 0u; i < group.count; ++i) {
        vec4 box = floats_at(group.first + i);
        bool visit = all(lessThanEqual(box.xy, own.zw)) && all(lessThanEqual(own.xy, box.zw));
        boxes |= visit ? 1u << i : 0u;
    }
    add_boxes(walk, boxes);
}

uint verdict_of(uint direction_index, uint edge_slot) {
    SearchDirectionData direction = direction_at(direction_index);
    Shape b = shape_at(direction.shape_b);
    vec4 edge = floats_at(shape_at(direction.shape_a).edges + edge_slot);
    vec2 from = placed(direction, edge.xy);
    vec2 to = placed(direction, edge.zw);
    float margin = direction.reach + 2.0 * direction.margin;
    vec4 own = vec4(min(from, to) - margin, max(from, to) + margin);
    uint verdict = 0u;
    Walk walk = start_walk(b);
    for (uint steps = 0u; steps < max_steps && (verdict & pair_meets) == 0u; ++steps) {
        enter(walk, b, own);
        uint chunks = take_chunks(walk);
        steps += bitCount(chunks);
        while (chunks != 0u) {
            uint chunk = chunk_size * walk.group + take_bit(chunks);
            uint end = edges_end(b, chunk);
            for (uint slot = chunk_size * chunk; slot < end; ++slot) {
                verdict |= verdict_on(from, to, floats_at(b.edges + slot), margin);
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
