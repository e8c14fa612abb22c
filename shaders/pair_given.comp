#version 450
#extension GL_GOOGLE_include_directive : require

// The directions of the search where the host gives them, one thread per direction of the part: those
// of the batch, and how many there are of them and of their items.

#include "search.glsl"
#include "pairs.h"
#include "write_direction.glsl"

layout(local_size_x = group_size) in;

#include "totals.glsl"

layout(std430, set = 0, binding = 2) readonly buffer Given {
    uvec4 given_units[];  // SearchDirectionData, one after the other
};

uvec4 given_unit(uint number, uint i) {
    return given_units[units_of_direction * number + i];
}

void main() {
    uint number = push.first + dispatched_index();
    if (number >= push.end_instance) {
        return;
    }
    uint index = number - push.first_instance;
    vec4 place = uintBitsToFloat(given_unit(number, 0u));
    uvec4 shapes = given_unit(number, 1u);
    vec4 lengths = uintBitsToFloat(given_unit(number, 2u));
    uvec4 rest = given_unit(number, 3u);
    uint chunks = unit_at(shapes.x).x;
    uint first_item = shapes.w - given_unit(push.first_instance, 1u).w;
    if (index < push.capacity) {
        write_direction(index,
                        SearchDirectionData(place.xy, place.zw, shapes.x, shapes.y, shapes.z,
                                            first_item, lengths.x, lengths.y, lengths.z, lengths.w,
                                            uintBitsToFloat(rest.x), uintBitsToFloat(rest.y),
                                            rest.z, rest.w),
                        chunks, push.second_capacity);
    }
    if (number + 1u == push.end_instance) {
        begin_totals();
        scratch[has_too_many_pairs] = 0u;
        write_total(pair_total, index + 1u, push.capacity);
        write_total(item_total, first_item + chunks,
                    index < push.capacity ? push.second_capacity : 0u);
    }
}
