#version 450
#extension GL_GOOGLE_include_directive : require

// Writes the header of one resident output from what its summary says. One thread.

#include "layout.h"
#include "nearfield/nearfield.glsl"
#include "push.h"

layout(local_size_x = 1) in;

// The beginning of NearfieldSummary and of NearfieldIntersectionSummary. Not read for a field.
layout(std430, set = 0, binding = 2) readonly buffer Summary {
    uint found;
    uint capacity;
};
layout(std430, set = 0, binding = 3) writeonly buffer Header {
    NearfieldHeader header;
};

layout(push_constant) uniform Push { ExportHeaderPush push; };

uint groups_of(uint count, uint size) {
    return (count + size - 1u) / size;
}

void main() {
    bool is_field = push.width > 0u;
    uint count = is_field ? push.width * push.height : min(found, capacity);
    uvec3 groups = is_field ? uvec3(groups_of(push.width, field_group_side),
                                    groups_of(push.height, field_group_side), 1u)
                            : uvec3(groups_of(count, group_size), 1u, 1u);
    header.points = uvec4(count, 1u, 0u, 0u);
    header.quads = uvec4(6u, is_field ? 1u : count, 0u, 0u);
    header.groups = uint[3](groups.x, groups.y, groups.z);
    header.count = count;
    header.origin = push.origin;
    header.cell = push.cell;
    header.overflow = !is_field && found > capacity ? 1u : 0u;
    header.width = push.width;
    header.height = push.height;
}
