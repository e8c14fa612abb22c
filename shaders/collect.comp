#version 450
#extension GL_GOOGLE_include_directive : require

// Collects samples from a hit image of unsigned numbers.

#include "layout.glsl"

layout(local_size_x = overlap_group_width,
       local_size_y = overlap_group_height / overlap_cells_per_thread) in;

layout(set = 0, binding = 4) uniform usampler2D hit_image;

uint hit_at(ivec2 texel) {
    return texelFetch(hit_image, texel, 0).x;
}

#include "collect.glsl"
