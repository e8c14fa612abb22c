#version 450

// Writes the id of the feature that was drawn.

layout(location = 0) flat in uint feature;
layout(location = 0) out uint color;

void main() {
    color = feature;
}
