#version 450

layout(location = 0) flat in uint inside;
layout(location = 0) out vec4 color;

void main() {
    color = inside != 0u ? vec4(0.0, 0.4, 0.0, 1.0) : vec4(0.4, 0.0, 0.4, 1.0);
}
