// Whether a ring of one shape lies in the other, of shapes whose boundaries do not meet. Such a ring
// is inside where its first vertex is. Include after search.glsl.

#include "pairs.h"

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

// A search for a ring of one shape in the other.
struct RingSearch {
    uint ring;  // the next one
    bool follows;
    Ray ray;  // of the one before
};

// One step, which may come to a verdict; false at the end.
bool step_in_rings(SearchDirectionData direction, inout RingSearch rings, inout uint verdict) {
    if (rings.follows) {
        rings.follows = follow(rings.ray);
        verdict = !rings.follows && rings.ray.odd ? pair_meets : verdict;
        return true;
    }
    uint rings_of_a = unit_at(direction.shape_a + unit_of_rings).x;
    if (rings.ring == rings_of_a + unit_at(direction.shape_b + unit_of_rings).x) {
        return false;
    }
    bool of_a = rings.ring < rings_of_a;
    rings.follows =
        start_ray(direction, of_a, of_a ? rings.ring : rings.ring - rings_of_a, rings.ray);
    ++rings.ring;
    return true;
}

// Of boundaries that do not meet: whether a ring of one shape lies in the other. One loop over all
// rays, since some drivers add up the turns of all loops (max_instance_steps).
uint find_ring_inside(SearchDirectionData direction) {
    RingSearch rings;
    rings.ring = 0u;
    rings.follows = false;
    uint verdict = 0u;
    for (uint i = 0u; i < max_ring_turns; ++i) {
        if (!step_in_rings(direction, rings, verdict) || verdict != 0u) {
            return verdict;
        }
    }
    return pair_in_doubt;
}
