#version 450
#extension GL_GOOGLE_include_directive : require

// As number.frag, for an attachment of four bytes.

#include "color.glsl"

layout(location = 0) flat in uint number;
layout(location = 0) out vec4 color;

void main() {
    color = color_of(number);
}
