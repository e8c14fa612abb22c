// The header of what stays on the device. Include after nearfield.glsl and layout.h.

// Of `count` points or samples that are stored.
NearfieldHeader header_of(uint count, vec2 origin, float cell, bool overflows) {
    uint groups = (count + group_size - 1u) / group_size;
    return NearfieldHeader(uvec4(count, 1u, 0u, 0u), uvec4(6u, count, 0u, 0u),
                           uint[3](groups, 1u, 1u), count, origin, cell, overflows ? 1u : 0u, 0u, 0u);
}

// Of a field of so many cells.
NearfieldHeader header_of_field(uvec2 size, vec2 origin, float cell) {
    uint count = size.x * size.y;
    uvec2 groups = (size + field_group_side - 1u) / field_group_side;
    return NearfieldHeader(uvec4(count, 1u, 0u, 0u), uvec4(6u, 1u, 0u, 0u),
                           uint[3](groups.x, groups.y, 1u), count, origin, cell, 0u, size.x, size.y);
}
