#version 450
#extension GL_GOOGLE_include_directive : require

// Before all pairs, where the host's own commands write the poses, one thread per instance: its place, as
// device_input::set_place() has it, and the pose itself for the CPU.

#include "push.h"
#include "shapes.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) readonly buffer Poses {
    float poses[];
};
layout(std430, set = 0, binding = 2) buffer Instances {
    uvec4 instances[];  // PairQueryData, then one instance after the other
};
layout(std430, set = 0, binding = 3) buffer Taken {
    uvec4 taken[];
};
layout(std430, set = 0, binding = 3) buffer TakenWords {
    uint taken_words[];  // the same memory
};

layout(push_constant) uniform Push { PosePush push; };

// By its bits: shaders may be compiled as if there were no such numbers.
bool is_finite(vec4 numbers) {
    const uint exponent = 0x7f800000u;
    return all(notEqual(floatBitsToUint(numbers) & exponent, uvec4(exponent)));
}

bool is_usable(vec4 pose) {
    float square = dot(pose.zw, pose.zw);
    return is_finite(pose) && all(lessThanEqual(abs(pose.xy), vec2(push.largest))) &&
           abs(square - 1.0) <= allowed_stretch;
}

float larger_of(vec2 numbers) {
    return max(numbers.x, numbers.y);
}

void main() {
    uint number = push.first + gl_GlobalInvocationID.x;
    if (number >= push.instances) {
        return;
    }
    uint unit = units_of_query + units_of_instance * number;
    uvec4 lengths = instances[unit + 1u];
    uint shape = instances[unit + 2u].x;
    uvec4 doubts = instances[unit + 3u];
    uint word = push.stride * doubts.z;
    vec4 pose = vec4(poses[word], poses[word + 1u], poses[word + 2u], poses[word + 3u]);
    taken[1u + number] = floatBitsToUint(pose);
    if (!is_usable(pose)) {
        atomicMin(taken_words[0], number);
        pose = vec4(0.0, 0.0, 1.0, 0.0);
    }
    vec2 axis = pose.zw / length(pose.zw);
    vec2 centre = uintBitsToFloat(unit_at(shape + unit_of_rings).zw);
    vec2 turned = mat2(axis.x, axis.y, -axis.y, axis.x) * centre;
    // The sum, and exactly what its rounding leaves out.
    precise vec2 high = pose.xy + turned;
    precise vec2 added = high - pose.xy;
    precise vec2 low = (pose.xy - (high - added)) + (turned - added);
    float lever = uintBitsToFloat(lengths.w) + abs(centre.x) + abs(centre.y);
    float magnitude = push.origin + larger_of(abs(pose.xy)) + lever;
    doubts.x &= left_by_shape;
    doubts.x |= magnitude > push.farthest ? left_by_place : 0u;
    doubts.y = floatBitsToUint(rounding_of_turn * lever + rounding_of_place * magnitude);
    doubts.w = doubts.y;
    instances[unit] = floatBitsToUint(vec4(axis, high));
    instances[unit + 1u] = uvec4(floatBitsToUint(low), lengths.zw);
    instances[unit + 3u] = doubts;
}
