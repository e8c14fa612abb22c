#version 450
#extension GL_GOOGLE_include_directive : require

// A host's arrows for contacts, one instance per record of the capacity: instances beyond the count
// are degenerate, so that the host need not know the count.

#include "nearfield/nearfield.glsl"
#include "view.glsl"

layout(std430, set = 0, binding = 2) readonly buffer Contacts {
    NearfieldSummary summary;
    NearfieldPoint records[];
};

layout(location = 0) flat out uint inside;

// Along the arrow and across it, as fractions of its length.
const vec2 corners[9] = vec2[9](vec2(0.0, -0.05), vec2(0.7, -0.05), vec2(0.7, 0.05),
                                vec2(0.0, -0.05), vec2(0.7, 0.05), vec2(0.0, 0.05),
                                vec2(0.65, -0.2), vec2(1.0, 0.0), vec2(0.65, 0.2));

void main() {
    uint index = uint(gl_InstanceIndex);
    inside = 0u;
    gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
    if (index >= summary.count) {
        return;
    }
    NearfieldPoint record = records[index];
    inside = nearfield_is_inside(record.feature) ? 1u : 0u;
    vec2 corner = view.arrow_length * corners[gl_VertexIndex];
    // Out of B, as nearly as a point of its boundary tells it.
    vec2 along = (record.flags & nearfield_on_b_flag) != 0u ? -record.normal : record.normal;
    vec2 across = vec2(-along.y, along.x);
    vec2 place = record.position + corner.x * along + corner.y * across;
    gl_Position = in_picture(place - view.records_low);
}
