#version 450

// A plain colour, multiplied for glyphs by how much of the pixel they cover.

layout(location = 0) in vec2 place;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 painted;
layout(set = 0, binding = 0) uniform sampler2D letters;  // 1 beyond its border

void main() {
    painted = vec4(color.rgb, color.a * texture(letters, place).r);
}
