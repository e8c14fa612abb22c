#version 450
#extension GL_GOOGLE_include_directive : require

// As color.frag, but only in the mesh's own tile.

#include "color.glsl"
#include "tile.glsl"

layout(location = 0) flat in uint number;
layout(location = 0) out vec4 color;

void main() {
    discard_outside_tile();
    color = color_of(number);
}
