#version 450
#extension GL_GOOGLE_include_directive : require

// A host's picture of a distance field: red inside, blue outside, lines of equal distance, a tint
// for each nearest feature.

#include "nearfield/nearfield.glsl"
#include "view.glsl"

layout(set = 0, binding = 0) uniform sampler2D signed_distance;
layout(set = 0, binding = 1) uniform usampler2D feature_id;
layout(set = 0, binding = 4) uniform texture2D same_distance;  // as engines bind that keep them apart
layout(set = 0, binding = 5) uniform sampler any_sampler;

layout(location = 0) out vec4 color;

float tint_of(uint feature) {
    uint number = 2u * nearfield_index(feature) + (nearfield_is_vertex(feature) ? 1u : 0u);
    return float((number * 2654435761u) >> 24) / 255.0;
}

void main() {
    vec2 pixel = vec2(gl_FragCoord.x, view.pixels.y - gl_FragCoord.y);
    vec2 texel = nearfield_texel(view.field_low + view.step * pixel, vec2(0.0), view.cell);
    float distance =
        int(gl_FragCoord.x) % 2 == 0
            ? nearfield_signed_distance(signed_distance, view.cells, texel)
            : nearfield_signed_distance(same_distance, any_sampler, view.cells, texel);
    ivec2 cell = clamp(ivec2(floor(texel)), ivec2(0), view.cells - 1);
    uint feature = texelFetch(feature_id, cell, 0).x;

    vec3 side = distance < 0.0 ? vec3(0.98, 0.62, 0.45) : vec3(0.55, 0.72, 0.95);
    vec3 mixed = side + 0.10 * (tint_of(feature) - 0.5);
    float lines = abs(fract(distance / view.line_spacing + 0.5) - 0.5) * view.line_spacing;
    if (lines < 0.6 * view.step) {
        mixed *= 0.85;
    }
    if (abs(distance) < 1.2 * view.step) {
        mixed = vec3(0.15);
    }
    color = vec4(mixed, 1.0);
}
