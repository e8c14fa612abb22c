// The search for boundary points (search.h): access to its input. All positions and lengths are in
// B's frame, relative to its centre, in its units.

#include "push.h"
#include "shapes.glsl"

// Directions, and how many items there are, are in the scratch memory (pairs.h).
layout(constant_id = 1) const bool finds_pairs = false;

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 1) buffer ScratchUnits {
    uvec4 scratch_units[];  // the same memory
};

layout(push_constant) uniform Push { SearchPush push; };

// Beside the direction of a thread's first point, from this bit on: the points found before it.
const uint local_shift = 24u;

uint dispatched_index() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * search_block +
           gl_LocalInvocationID.x;
}

uint item_count() {
    return finds_pairs ? scratch[item_total] : push.items;
}

// A unit of a direction.
uvec4 direction_unit(uint index, uint i) {
    uint unit = push.directions + units_of_direction * index + i;
    return finds_pairs ? scratch_units[unit] : unit_at(unit);
}

SearchDirectionData direction_at(uint index) {
    vec4 place = uintBitsToFloat(direction_unit(index, 0u));
    uvec4 shapes = direction_unit(index, 1u);
    vec4 lengths = uintBitsToFloat(direction_unit(index, 2u));
    return SearchDirectionData(place.xy, place.zw, shapes.x, shapes.y, shapes.z, shapes.w,
                               lengths.x, lengths.y, lengths.z, lengths.w,
                               uintBitsToFloat(direction_unit(index, 3u).x),
                               float[3](0.0, 0.0, 0.0));
}

// From A's frame to B's, with the ratio of their units.
mat2 rotation_of(SearchDirectionData direction) {
    return mat2(direction.axis.x, direction.axis.y, -direction.axis.y, direction.axis.x);
}

// A point of A's frame in B's.
vec2 placed(SearchDirectionData direction, vec2 point) {
    return rotation_of(direction) * point + direction.offset;
}

// The direction of the first item of a block.
uint first_direction(uint block) {
    // These follow the directions in the input.
    return finds_pairs ? scratch[push.first_directions + block]
                       : word_at(4u * (push.directions + units_of_direction * push.direction_count) +
                                 block);
}

// The direction that an item belongs to.
uint direction_of(uint item) {
    uint block = item / search_block;
    uint low = first_direction(block);
    uint directions = finds_pairs ? scratch[pair_total] : push.direction_count;
    uint count = (search_block * (block + 1u) < item_count() ? first_direction(block + 1u) + 1u
                                                             : directions) - low;
    while (count > 1u) {
        uint half_count = count / 2u;
        if (direction_unit(low + half_count, 1u).w <= item) {
            low += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    return low;
}

uint parts_of(SearchDirectionData direction, uint edge) {
    return direction.parts == no_parts ? 1u : word_at(direction.parts + edge);
}

// The last of `count` words of the scratch memory, `stride` apart, whose value without its low bits
// is at most `key`; the values ascend.
uint last_at_most(uint key, uint first, uint count, uint stride, uint low_bits) {
    uint last = 0u;
    while (count > 1u) {
        uint half_count = count / 2u;
        if (scratch[first + stride * (last + half_count)] >> low_bits <= key) {
            last += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    return last;
}

// The block of elements that counts an element of the next stage. `elements`: of all blocks.
uint block_of(uint index, uint first_block, uint elements) {
    return last_at_most(index, first_block, (elements + search_block - 1u) / search_block, 1u, 0u);
}

bool crosses(vec2 p, vec2 a, vec2 b) {
    // Half-open in y, so a vertex on the ray counts once.
    return (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
}

bool ray_meets(vec2 p, vec4 box) {
    return p.y >= box.y && p.y <= box.w && p.x <= box.z;
}

// The steps of one walk, each of which takes up to nine turns of loops. Some drivers end the loops of
// an invocation without notice after 65,535 turns: a thread of search_points.comp has up to four runs
// of three walks each, and the threads that run in step with it may take the longest of each. What a
// longer walk would find is left to the CPU, which takes less time than long walks where boxes do
// not tell the edges apart.
const uint max_steps = 256u;
