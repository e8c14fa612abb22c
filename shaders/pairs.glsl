// The pairs of a world's instances (pairs.h): access to the instances and to the boxes over them.
// Include after search.glsl.

#include "pairs.h"

layout(std430, set = 0, binding = 2) readonly buffer Instances {
    uvec4 instance_units[];  // PairQueryData, then one instance after the other
};
layout(std430, set = 0, binding = 2) readonly buffer InstanceWords {
    uint instance_words[];  // the same memory
};

PairQueryData pair_query() {
    uvec4 first = instance_units[0];
    uvec4 second = instance_units[1];
    vec4 lengths = uintBitsToFloat(first);
    return PairQueryData(lengths.x, lengths.y, lengths.z, first.w, uintBitsToFloat(second.x),
                         second.y, second.z, uint[1](0u));
}

// Of contacts: points outside the other shape are asked for, too.
bool asks_outside(PairQueryData query) {
    return query.is_test == 0u && query.reach > 0.0;
}

// A unit of an instance.
uvec4 instance_unit(uint number, uint i) {
    return instance_units[units_of_query + units_of_instance * number + i];
}

SearchInstanceData instance_at(uint number) {
    vec4 turned = uintBitsToFloat(instance_unit(number, 0u));
    vec4 lengths = uintBitsToFloat(instance_unit(number, 1u));
    uvec4 third = instance_unit(number, 2u);
    uvec4 last = instance_unit(number, 3u);
    return SearchInstanceData(turned.xy, turned.zw, lengths.xy, lengths.z, lengths.w, third.x,
                              third.y, third.z, third.w, last.x, uintBitsToFloat(last.y), last.z,
                              uintBitsToFloat(last.w));
}

// Everything happens in floats: rounded sines and cosines, a handful of operations, each of which
// errs by at most 2^-24 of its result. 2^-20 of the largest coordinates covers them. The places of
// the instances are known to 2^-47 of theirs.
const float margin_of_frames = 1.0 / 1048576.0;
const float margin_of_places = 1.0 / 140737488355328.0;

float sum_of(vec2 v) {
    return abs(v.x) + abs(v.y);
}

// A's frame in B's, their shapes, and the bound on the errors.
SearchDirectionData frames_of(SearchInstanceData a, SearchInstanceData b) {
    vec2 apart = (a.high - b.high) + (a.low - b.low);
    mat2 to_b = mat2(b.axis.x, -b.axis.y, b.axis.y, b.axis.x);
    SearchDirectionData direction;
    direction.axis = (a.unit / b.unit) * (to_b * a.axis);
    direction.offset = (to_b * apart) / b.unit;
    direction.shape_a = a.shape;
    direction.shape_b = b.shape;
    float extent = (a.radius + b.radius) / b.unit + length(direction.offset);
    float places = (sum_of(a.high) + sum_of(b.high)) / b.unit;
    direction.margin = margin_of_frames * extent + margin_of_places * places +
                       2.0 * (a.rounding + b.rounding) / b.unit;
    return direction;
}

// The number of the instance at a place in the hierarchy.
uint instance_in_order(uint place) {
    return instance_words[instance_units[0].w + place];
}

// The number of boxes on a level.
uint level_size(uint level) {
    return (push.instances + (1u << (3u * level)) - 1u) >> (3u * level);
}

uint size_below(uint level, uint lower) {
    return level > lower ? level_size(lower) : 0u;
}

// The first unit of a level; without a loop, since it is called in each step of long ones.
uint level_unit(uint level) {
    return push.boxes + size_below(level, 0u) + size_below(level, 1u) + size_below(level, 2u) +
           size_below(level, 3u) + size_below(level, 4u) + size_below(level, 5u);
}

// The unit behind all levels that says which instance is at a place of the lowest one: its number,
// its category and its mask.
uint place_unit(uint place) {
    return level_unit(instance_levels) + place;
}

vec4 merged(vec4 a, vec4 b) {
    return vec4(min(a.xy, b.xy), max(a.zw, b.zw));
}

const vec4 empty_box = vec4(infinity, infinity, -infinity, -infinity);
