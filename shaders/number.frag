#version 450

// Writes a number wherever the stencil or depth test passes.

layout(location = 0) flat in uint number;
layout(location = 0) out uint color;

void main() {
    color = number;
}
