#version 450
#extension GL_GOOGLE_include_directive : require

// Whether two shapes' boundaries meet or, in a test, are within reach, one thread per edge of A that
// comes near B. Ends where another edge of the same pair is known to be.

#include "search.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

float cross_product(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// Whether both ends of a segment are on the same side of another's line and farther from it than a
// length. `areas`: twice those of the triangles of the other with each end. `limit`: the length times
// one that is not below the other's.
bool are_on_one_side(vec2 areas, float limit) {
    return min(areas.x, areas.y) > limit || max(areas.x, areas.y) < -limit;
}

// The same on opposite sides.
bool are_on_two_sides(vec2 areas, float limit) {
    return min(areas.x, areas.y) < -limit && max(areas.x, areas.y) > limit;
}

// The least distance of an end of either segment from the other.
float distance_of_ends(vec2 a, vec2 b, vec4 edge) {
    float of_edge = min(distance(edge.xy, nearest_on_segment(edge.xy, a, b)),
                        distance(edge.zw, nearest_on_segment(edge.zw, a, b)));
    float of_own = min(distance(a, nearest_on_segment(a, edge.xy, edge.zw)),
                       distance(b, nearest_on_segment(b, edge.xy, edge.zw)));
    return min(of_edge, of_own);
}

// What is near, and what is far, for certain; and how far from each other's lines are the ends of
// segments that cross for certain.
struct Limits {
    float near;
    float far;
    float margin;
};

Limits limits_of(SearchDirectionData direction) {
    // The reach of contacts is not that of the boundaries.
    float reach = direction.outside != 0.0 ? direction.margin : direction.reach;
    return Limits(reach - 4.0 * direction.margin, reach + 2.0 * direction.margin,
                  3.0 * direction.margin);
}

// Of the segments from `a` to `b` and along `edge`.
uint verdict_on(vec2 a, vec2 b, vec4 edge, Limits limits) {
    vec2 along = b - a;
    vec2 other = edge.zw - edge.xy;
    // The sum of the components does not vanish where their squares would.
    float size = abs(along.x) + abs(along.y);
    float other_size = abs(other.x) + abs(other.y);
    vec2 ends = vec2(cross_product(along, edge.xy - a), cross_product(along, edge.zw - a));
    vec2 own_ends = vec2(cross_product(other, a - edge.xy), cross_product(other, b - edge.xy));
    vec2 gap = max(min(a, b), min(edge.xy, edge.zw)) - min(max(a, b), max(edge.xy, edge.zw));
    if (max(gap.x, gap.y) > limits.far || are_on_one_side(ends, limits.far * size) ||
        are_on_one_side(own_ends, limits.far * other_size)) {
        return 0u;
    }
    if (are_on_two_sides(ends, limits.margin * size) &&
        are_on_two_sides(own_ends, limits.margin * other_size)) {
        return pair_meets;
    }
    // Of segments that cross without being known to, an end is no farther from the other than the
    // margin times the ratio of the sum to the length, which is at most the root of 2.
    float nearest = distance_of_ends(a, b, edge);
    return nearest <= limits.near                       ? pair_meets
           : nearest <= limits.far + 0.5 * limits.margin ? pair_in_doubt
                                                         : 0u;
}

// The boxes of a walk's group that overlap with a box.
void enter(inout Walk walk, Shape b, vec4 own) {
    Group group = group_of(b, walk.level, walk.group);
    uint boxes = 0u;
    vec4 next = floats_at(group.first);
    for (uint i = 0u; i < group.count; ++i) {
        vec4 box = next;
        next = floats_at(group.first + i + 1u);
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
