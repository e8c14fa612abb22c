// The search for boundary points (search.h): access to its directions. All positions and lengths are
// in B's frame, relative to its centre, in its units.

#include "push.h"
#include "shapes.glsl"
#include "scratch.glsl"
#include "frames.glsl"

layout(push_constant) uniform Push { SearchPush push; };

// Beside the direction of a point, from this bit on: the points found before it in its workgroup.
const uint local_shift = 24u;
// In place of the depth of a point that was not found.
const float nothing_found = -2.0;

uint dispatched_index() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * search_block +
           gl_LocalInvocationID.x;
}

uint item_count() {
    return scratch[item_total];
}

uint direction_count() {
    return scratch[pair_total];
}

// Whether the pairs with this instance first are of the part that is searched.
bool is_in_part(uint a) {
    return a - push.first_instance < push.end_instance - push.first_instance;
}

// A unit of a direction.
uvec4 direction_unit(uint index, uint i) {
    return scratch_unit(push.directions + units_of_direction * index + i);
}

SearchDirectionData direction_at(uint index) {
    vec4 place = uintBitsToFloat(direction_unit(index, 0u));
    uvec4 shapes = direction_unit(index, 1u);
    vec4 lengths = uintBitsToFloat(direction_unit(index, 2u));
    uvec4 rest = direction_unit(index, 3u);
    return SearchDirectionData(place.xy, place.zw, shapes.x, shapes.y, shapes.z, shapes.w,
                               lengths.x, lengths.y, lengths.z, lengths.w,
                               uintBitsToFloat(rest.x), uintBitsToFloat(rest.y), rest.z, rest.w);
}

// The direction of the first item of a block.
uint first_direction(uint block) {
    return scratch_word(push.first_directions + block);
}

// The direction that an item belongs to.
uint direction_of(uint item) {
    uint block = item / search_block;
    uint low = first_direction(block);
    uint count = (search_block * (block + 1u) < item_count() ? first_direction(block + 1u) + 1u
                                                             : direction_count()) - low;
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

// The last of `count` words of the scratch memory, `stride` apart, whose value is at most `key`; the
// values ascend. Three loads at once take half as many steps as one.
uint last_at_most(uint key, uint first, uint count, uint stride) {
    uint last = 0u;
    while (count > 1u) {
        uint step = (count + 3u) / 4u;
        uvec3 places = step * uvec3(1u, 2u, 3u);
        uvec3 found = min(places, uvec3(count - 1u));
        uvec3 words = uvec3(scratch_word(first + stride * (last + found.x)),
                            scratch_word(first + stride * (last + found.y)),
                            scratch_word(first + stride * (last + found.z)));
        uvec3 passed = uvec3(lessThan(places, uvec3(count))) &
                       uvec3(lessThanEqual(words, uvec3(key)));
        uint skipped = step * (passed.x + passed.y + passed.z);
        last += skipped;
        count = min(count - skipped, step);
    }
    return last;
}

// The edges of the items before one, or of all.
uint edges_before(uint item) {
    uint total = scratch[edge_total];
    return item < item_count()
               ? min(scratch_word(push.item_blocks + item / search_block) +
                         (scratch_word(push.item_words + words_of_item * item) >> 8),
                     total)
               : total;
}

// The place of the first point of an edge in the next step, among those of all edges.
uint place_of(uint edge) {
    return scratch_word(push.edge_blocks + edge / search_block) +
           scratch_word(4u * (push.edge_units + units_of_edge * edge) + 3u);
}

// The steps of one walk, which are its groups and chunks, each of which takes up to ten turns of loops.
// Some drivers end the loops of an invocation without notice after 65,535 turns: a thread of
// search_points.comp walks up to three times, and threads that run in step wait for the longest loop of
// each. What a longer walk would find is left to the CPU, which takes less time than long walks where
// boxes do not tell the edges apart.
const uint max_steps = 256u;
