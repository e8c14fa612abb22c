#version 450

// Writes one value wherever the stencil or depth test lets it.

layout(push_constant) uniform Push {
    layout(offset = 20) uint value;
} push;

layout(location = 0) out uint color;

void main() {
    color = push.value;
}
