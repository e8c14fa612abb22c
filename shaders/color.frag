#version 450

// As number.frag, for an attachment of four bytes in [0, 1]. Vulkan does not require rounding to
// nearest when a byte is stored, so a quarter is added to preserve it; the sum of two such values
// stays below the next byte.

layout(location = 0) flat in uint number;
layout(location = 0) out vec4 color;

void main() {
    uvec4 bytes = (uvec4(number) >> uvec4(0u, 8u, 16u, 24u)) & 255u;
    color = (vec4(bytes) + 0.25) / 255.0;
}
