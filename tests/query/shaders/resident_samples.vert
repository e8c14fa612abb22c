#version 450
#extension GL_GOOGLE_include_directive : require

// A host's dots for the samples of an intersection, one instance per sample of the capacity:
// instances beyond the count are degenerate, so that the host need not know the count.

#include "nearfield/nearfield.glsl"
#include "view.glsl"

layout(std430, set = 0, binding = 3) readonly buffer Intersection {
    NearfieldIntersectionSummary summary;
    NearfieldIntersectionSample samples[];
};

// Across a dot, as fractions of a cell.
const vec2 corners[6] = vec2[6](vec2(-0.2, -0.2), vec2(0.2, -0.2), vec2(0.2, 0.2),
                                vec2(-0.2, -0.2), vec2(0.2, 0.2), vec2(-0.2, 0.2));

void main() {
    uint index = uint(gl_InstanceIndex);
    gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
    if (index < summary.count) {
        vec2 place = samples[index].point + summary.cell * corners[gl_VertexIndex];
        gl_Position = in_picture(place - view.samples_low);
    }
}
