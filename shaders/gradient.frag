#version 450
#extension GL_GOOGLE_include_directive : require

// The distance image shifted by a number of pixels, along x for the first component and along y for
// the second; or a constant factor for blending.

#include "push.h"
#include "tile.glsl"

layout(std430, set = 0, binding = 3) readonly buffer Field {
    uint words[];
} field;

layout(push_constant) uniform Push { layout(offset = gradient_push_offset) GradientPush push; };

layout(location = 0) flat in uint first_value;
layout(location = 0) out vec2 color;

float value_at(ivec2 cell) {
    ivec2 size = ivec2(tile_rectangle.zw);
    ivec2 inside = clamp(cell, ivec2(0), size - 1);
    uint index = first_value + uint(inside.y * size.x + inside.x);
    float value = uintBitsToFloat(field.words[index]);
    return clamp(value, -push.largest, push.largest);
}

void main() {
    ivec2 cell = ivec2(cell_in_tile());
    color = push.shift == 0 ? vec2(push.factor)
                            : vec2(value_at(cell + ivec2(push.shift, 0)),
                                   value_at(cell + ivec2(0, push.shift)));
}
