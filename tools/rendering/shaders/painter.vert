#version 450

// Transforms pixels from the upper left corner to Vulkan's clip coordinates.

layout(location = 0) in vec2 pixel;
layout(location = 1) in vec2 place_of_corner;
layout(location = 2) in vec4 color_of_corner;
layout(location = 0) out vec2 place;
layout(location = 1) out vec4 color;
layout(push_constant) uniform Scale {
    vec2 scale;  // 2 / size of the page
};

void main() {
    gl_Position = vec4(pixel * scale - 1.0, 0.0, 1.0);
    place = place_of_corner;
    color = color_of_corner;
}
