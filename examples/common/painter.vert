#version 450

// Transforms pixels from the upper left corner to Vulkan's clip coordinates.

layout(location = 0) in vec2 pixel;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 color_of_corner;
layout(push_constant) uniform Scale {
    vec2 scale;  // 2 / size of the window
};

void main() {
    gl_Position = vec4(pixel * scale - 1.0, 0.0, 1.0);
    color_of_corner = color;
}
