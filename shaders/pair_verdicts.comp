#version 450
#extension GL_GOOGLE_include_directive : require

// Which pairs intersect, one thread per pair: those whose boundaries meet, and those of which one
// shape holds a ring of the other. A ring that meets nothing is inside where its first vertex is.

#include "search.glsl"
#include "block_sum.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

// A point of B's frame in A's.
vec2 placed_back(SearchDirectionData direction, vec2 point) {
    return (point - direction.offset) * rotation_of(direction) /
           dot(direction.axis, direction.axis);
}

// The first vertex of a ring.
vec2 ring_start(uint shape, uint ring) {
    uint chunk = word_at(unit_at(shape + unit_of_rings).y + ring);
    return floats_at(unit_at(shape).z + chunk_size * chunk).xy;
}

bool crosses(vec2 p, vec2 a, vec2 b) {
    // Half-open in y, so a vertex on the ray counts once.
    return (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
}

bool ray_meets(vec2 p, vec4 box) {
    return p.y >= box.y && p.y <= box.w && p.x <= box.z;
}

// A vertex of one shape, and a walk over those boxes of the other that its ray meets.
struct Ray {
    vec2 from;
    Shape other;
    Walk walk;
    bool enters;
    bool odd;
};

// Returns whether the ray has to be followed: its start may be inside.
bool start_ray(SearchDirectionData direction, bool of_a, uint ring, out Ray ray) {
    uint own = of_a ? direction.shape_a : direction.shape_b;
    uint other = of_a ? direction.shape_b : direction.shape_a;
    vec2 start = ring_start(own, ring);
    ray.from = of_a ? placed(direction, start) : placed_back(direction, start);
    ray.other = shape_at(other);
    ray.walk = start_walk(ray.other);
    ray.enters = true;
    ray.odd = false;
    vec4 box = box_of_shape(other);
    return all(greaterThan(ray.from, box.xy)) && all(lessThan(ray.from, box.zw));
}

// Returns false at the end of the ray.
bool follow(inout Ray ray) {
    if (ray.enters) {
        Group group = group_of(ray.other, ray.walk.level, ray.walk.group);
        uint boxes = 0u;
        for (uint i = 0u; i < group.count; ++i) {
            boxes |= ray_meets(ray.from, floats_at(group.first + i)) ? 1u << i : 0u;
        }
        add_boxes(ray.walk, boxes);
    }
    uint box;
    if (!next_box(ray.walk, box)) {
        return false;
    }
    ray.enters = ray.walk.level > 0u;
    if (ray.enters) {
        descend(ray.walk, box);
        return true;
    }
    uint end = edges_end(ray.other, box);
    for (uint slot = chunk_size * box; slot < end; ++slot) {
        vec4 edge = floats_at(ray.other.edges + slot);
        ray.odd = ray.odd != crosses(ray.from, edge.xy, edge.zw);
    }
    return true;
}

// Of boundaries that do not meet: whether a ring of one shape lies in the other. One loop over all
// rays, since some drivers add up the turns of all loops (max_instance_steps).
uint find_ring_inside(SearchDirectionData direction) {
    uint rings_of_a = unit_at(direction.shape_a + unit_of_rings).x;
    uint rings = rings_of_a + unit_at(direction.shape_b + unit_of_rings).x;
    uint ring = 0u;
    bool follows = false;
    Ray ray;
    for (uint i = 0u; i < max_ring_turns; ++i) {
        if (follows) {
            follows = follow(ray);
            if (!follows && ray.odd) {
                return pair_meets;
            }
        } else if (ring < rings) {
            bool of_a = ring < rings_of_a;
            follows = start_ray(direction, of_a, of_a ? ring : ring - rings_of_a, ray);
            ++ring;
        } else {
            return 0u;
        }
    }
    return pair_in_doubt;
}

// The count of the pair's row, with flags; 0 without one.
uint count_of(uint pair) {
    uint verdict = scratch[push.verdicts + pair];
    if (verdict == 0u) {
        verdict = find_ring_inside(direction_at(pair));
    }
    if ((verdict & pair_left_to_cpu) != 0u) {
        return row_undecided;
    }
    return (verdict & pair_meets) != 0u ? 1u : verdict != 0u ? row_undecided : 0u;
}

void main() {
    uint pair = dispatched_index();
    bool exists = pair < scratch[pair_total];
    uint count = exists ? count_of(pair) : 0u;
    uint before = sum_before(count != 0u ? 1u : 0u, push.row_blocks + pair / search_block);
    if (exists) {
        scratch_units[push.summaries + 2u * pair] = uvec4(0u, 0u, 0u, count);
        scratch_units[push.summaries + 2u * pair + 1u] = uvec4(before, 0u, 0u, 0u);
    }
}
