#version 450

// Writes a number byte by byte as a colour: to an image of bytes, red the lowest.

layout(location = 0) flat in uint number;
layout(location = 0) out vec4 color;

void main() {
    color = unpackUnorm4x8(number);
}
