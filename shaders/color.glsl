// A number for an attachment of four bytes in [0, 1]. Vulkan does not require rounding to nearest
// when a byte is stored, so a quarter is added to preserve it; the sum of two such values stays
// below the next byte.
vec4 color_of(uint number) {
    uvec4 bytes = (uvec4(number) >> uvec4(0u, 8u, 16u, 24u)) & 255u;
    return (vec4(bytes) + 0.25) / 255.0;
}
