#version 450
#extension GL_GOOGLE_include_directive : require

// A host's dots for the samples of an intersection, one instance per sample: the device counts them
// (NearfieldHeader::quads), and their places are a vertex attribute.

#include "nearfield/nearfield.glsl"
#include "view.glsl"

layout(std430, set = 0, binding = 3) readonly buffer Intersection {
    NearfieldIntersectionSummary summary;
};

layout(location = 0) in vec2 place_of_sample;  // NearfieldIntersectionSample::position

// Across a dot, as fractions of a cell.
const vec2 corners[6] = vec2[6](vec2(-0.2, -0.2), vec2(0.2, -0.2), vec2(0.2, 0.2),
                                vec2(-0.2, -0.2), vec2(0.2, 0.2), vec2(-0.2, 0.2));

void main() {
    vec2 place = place_of_sample + summary.cell * corners[gl_VertexIndex];
    gl_Position = in_picture(place - view.samples_low);
}
