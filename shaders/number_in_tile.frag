#version 450
#extension GL_GOOGLE_include_directive : require

// As number.frag, but only in the mesh's own tile.

#include "tile.glsl"

layout(location = 0) flat in uint number;
layout(location = 0) out uint color;

void main() {
    discard_outside_tile();
    color = number;
}
